#include "apps/signorini/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include "apps/signorini/show.hpp"
#include "core/io/convergence.hpp"

namespace signorini {
namespace {

std::vector<double> equivalent(const std::vector<Stress>& stress) {
  std::vector<double> values(stress.size());
  std::transform(stress.begin(), stress.end(), values.begin(), [](const Stress& s) { return von_mises(s); });
  return values;
}

std::vector<double> full_tensors(const std::vector<Stress>& stress) {
  std::vector<double> values;
  values.reserve(9 * stress.size());
  for (const auto& [xx, yy, zz, xy, yz, xz] : stress) values.insert(values.end(), {xx, xy, xz, xy, yy, yz, xz, yz, zz});
  return values;
}

struct ContactFields {
  std::vector<double> gap, pressure, contact, tangential;
};

template <int B>
ContactFields contact_fields(const ContactState<B>& state, std::size_t vertices) {
  ContactFields fields{std::vector<double>(vertices, std::numeric_limits<double>::quiet_NaN()),
                       std::vector<double>(vertices), std::vector<double>(vertices),
                       std::vector<double>(B > 1 ? 3 * vertices : 0)};
  for (const ContactNode<B>& node : state.nodes) {
    fields.gap[node.vertex] = std::fmin(fields.gap[node.vertex], node.gap);
    fields.pressure[node.vertex] += node.pressure;
    if (node.contact) fields.contact[node.vertex] = !node.friction ? 1 : node.sticks ? 3 : 2;
    if (B > 1 && node.area > 0)
      for (int i = 0; i < B; ++i) fields.tangential[3 * node.vertex + i] += node.tangential[i] / node.area;
  }
  return fields;
}

template <int D, int B>
Shown<D> shown(const MeshHierarchy<D>& hierarchy, const Results<D, B>& results) {
  const std::size_t vertices = hierarchy.finest().points.size();
  ContactFields contact = contact_fields(results.contact, vertices);
  Shown<D> out{hierarchy,
               {},
               {},
               B == 1 ? "u" : "von Mises stress",
               std::vector<Flags>(contact.contact.begin(), contact.contact.end()),
               {},
               {}};
  for (const auto& node : results.contact.nodes)
    if (out.touched.empty() || out.touched.back() != node.vertex) out.touched.push_back(node.vertex);
  if constexpr (B == 1) {
    out.value = results.u;
  } else {
    out.displacement = results.u;
    out.value = equivalent(results.stress);
    out.pressure = std::move(contact.pressure);
  }
  return out;
}

template <int D, int B>
std::vector<Panel> result_panels(const Shown<D>& shown, std::vector<std::string>& notes) {
  std::vector<Panel> panels = B == 1 ? scalar_panels(shown, notes) : elastic_panels(shown, notes);
  std::erase_if(panels, [](const Panel& panel) { return panel.patches.empty() && panel.curve.empty(); });
  return panels;
}

void finish(Gnuplot& gnuplot, const char* picture, std::vector<std::string>& warnings) {
  const std::string problem = gnuplot.finish();
  if (!problem.empty()) warnings.push_back(fmt::format("{} was not drawn: {}", picture, problem));
}

}  // namespace

template <int D, int B>
std::vector<VtuField> point_fields(const Mesh<D>& mesh, const Results<D, B>& results) {
  std::vector<VtuField> fields;
  fields.push_back({B == 1 ? "u" : "displacement", B, results.u});
  if constexpr (B > 1) {
    fields.push_back({"stress", 9, full_tensors(results.stress)});
    fields.push_back({"von_mises", 1, equivalent(results.stress)});
  }
  if (results.contact.obstacles.empty()) return fields;
  ContactFields contact = contact_fields(results.contact, mesh.points.size());
  fields.push_back({"gap", 1, std::move(contact.gap)});
  fields.push_back({"contact_pressure", 1, std::move(contact.pressure)});
  if (B > 1) fields.push_back({"tangential_traction", 3, std::move(contact.tangential)});
  fields.push_back({"contact", 1, std::move(contact.contact)});
  return fields;
}

template <int D>
void SolutionFiles::add(const Mesh<D>& mesh, const std::vector<VtuField>& fields, double t) {
  const std::string name = steps_ == 1 ? "solution.vtu" : fmt::format("solution_{:03}.vtu", entries_.size() + 1);
  write_vtu(files_.stage(name), mesh, fields, {}, packing_);
  entries_.push_back({t, name});
}

void SolutionFiles::finish() const {
  if (!entries_.empty() && steps_ > 1) write_pvd(files_.stage("solution.pvd"), entries_);
}

bool is_result_file(const std::string& name) {
  constexpr std::array<std::string_view, 7> fixed = {
      "report.json", "solution.vtu", "solution.pvd", "convergence.csv", "phases.csv", "convergence.png", "result.png"};
  if (std::find(fixed.begin(), fixed.end(), name) != fixed.end()) return true;
  constexpr std::string_view start = "solution_", end = ".vtu";
  if (!name.starts_with(start) || !name.ends_with(end) || name.size() < start.size() + 3 + end.size()) return false;
  return std::all_of(name.begin() + start.size(), name.end() - end.size(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

template <int D, int B>
void Pictures::start(const MeshHierarchy<D>& hierarchy, const Results<D, B>& results, Report& report) {
  draw_convergence(convergence_.emplace(), files_.stage("convergence.png"), report.last().summary.history);
  const auto panels = result_panels<D, B>(shown(hierarchy, results), report.warnings);
  if (!panels.empty()) draw_panels(result_.emplace(), files_.stage("result.png"), panels);
}

void Pictures::finish(Report& report) {
  if (result_) signorini::finish(*result_, "result.png", report.warnings);
  if (convergence_) signorini::finish(*convergence_, "convergence.png", report.warnings);
}

void write_tables(AtomicFiles& files, const Report& report) {
  std::vector<const Summary*> summaries;
  for (const StepReport& step : report.steps) summaries.push_back(&step.summary);
  write_text(files.stage("convergence.csv"), convergence_csv(summaries));
  write_text(files.stage("phases.csv"), phases_csv(summaries));
}
#define SIGNORINI_OUTPUT(D, B)                                                       \
  template std::vector<VtuField> point_fields(const Mesh<D>&, const Results<D, B>&); \
  template void Pictures::start(const MeshHierarchy<D>&, const Results<D, B>&, Report&);
SIGNORINI_OUTPUT(2, 1)
SIGNORINI_OUTPUT(3, 1)
SIGNORINI_OUTPUT(2, 2)
SIGNORINI_OUTPUT(3, 3)

template void SolutionFiles::add(const Mesh<2>&, const std::vector<VtuField>&, double);
template void SolutionFiles::add(const Mesh<3>&, const std::vector<VtuField>&, double);

}  // namespace signorini
