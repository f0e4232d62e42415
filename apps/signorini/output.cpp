#include "apps/signorini/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <new>

#include "apps/signorini/show.hpp"
#include "apps/signorini/show_steps.hpp"
#include "core/base/error.hpp"
#include "core/fem/recovery/meeting_faces.hpp"
#include "core/io/convergence.hpp"
#include "core/io/steps_table.hpp"
#include "core/io/warning_kinds.hpp"
#include "driver/scene/numbers.hpp"

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

}  // namespace

template <int D, int B>
ContactFields contact_fields(const Nodes<D>& nodes, const Results<D, B>& results) {
  const auto size = static_cast<std::size_t>(nodes.size());
  ContactFields fields{std::vector<double>(size, std::numeric_limits<double>::quiet_NaN()),
                       std::vector<double>(size),
                       std::vector<double>(size),
                       std::vector<double>(size),
                       std::vector<double>(B > 1 ? 3 * size : 0),
                       std::vector<double>(B > 1 ? 3 * size : 0)};
  const auto add = [&](const ContactNode<B>& node, double part = 1) {
    fields.gap[node.vertex] = std::fmin(fields.gap[node.vertex], node.gap);
    fields.pressure[node.vertex] += part * node.recovered;
    fields.nodal_pressure[node.vertex] += part * node.pressure;
    const double contact = !node.contact ? 0 : !node.friction ? 1 : node.sticks ? 3 : 2;
    fields.contact[node.vertex] = std::max(fields.contact[node.vertex], contact);
    if (B == 1 || !(node.area > 0)) return;
    for (int i = 0; i < B; ++i) {
      const std::size_t at = 3 * std::size_t(node.vertex) + i;
      fields.tangential[at] += part * node.traction[i];
      fields.normal[at] += part * (node.force[i] - node.tangential[i]) / node.area;
    }
  };
  std::vector<ContactNode<B>> all = results.contact.nodes;
  all.insert(all.end(), results.masters.begin(), results.masters.end());  // a node may be at several interfaces
  std::ranges::stable_sort(all, {}, &ContactNode<B>::vertex);
  for (const ContactNode<B>& node : all) add(node, part_of_meeting(all, node));
  for (auto* field : {&fields.gap, &fields.pressure, &fields.nodal_pressure, &fields.contact})
    *field = nodes.per_vertex(std::move(*field), 1);
  if (B > 1)
    for (auto* field : {&fields.normal, &fields.tangential}) *field = nodes.per_vertex(std::move(*field), 3);
  return fields;
}

namespace {

template <int D, int B>
std::vector<Reached> reached(const Nodes<D>& nodes, const Results<D, B>& results, const std::vector<int>& numbers) {
  std::vector<Reached> out;
  std::vector<char> touched(nodes.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    std::ranges::fill(touched, 0);
    for (const auto& node : results.contact.nodes)
      if (node.obstacle == static_cast<Index>(k)) touched[node.vertex] = 1;
    for (Index v = 0; v < nodes.mesh().vertices(); ++v)
      if (touched[nodes.of_vertex(v)]) out.push_back({v, numbers[k]});
  }
  return out;
}

template <int D, int B>
Shown<D> shown(const MeshHierarchy<D>& hierarchy, const Nodes<D>& nodes, const Results<D, B>& results,
               const std::vector<Stress>& stress, const ContactFields& contact, const std::vector<int>& numbers) {
  Shown<D> out{hierarchy,
               {},
               {},
               B == 1 ? "u" : "von Mises stress",
               std::vector<Flags>(contact.contact.begin(), contact.contact.end()),
               {},
               {},
               {}};
  out.two_bodies =
      std::ranges::any_of(results.slaves, [](const SlaveChoice& choice) { return !choice.reason.empty(); });
  if constexpr (B == 1) {
    out.value = nodes.at_vertices(results.u, B);
  } else {
    out.reached = reached(nodes, results, numbers);
    out.displacement = nodes.at_vertices(results.u, B);
    out.value = equivalent(stress);
    out.pressure = contact.pressure;
    out.tangential = contact.tangential;
  }
  return out;
}

template <int D, int B>
std::vector<Panel> result_panels(const Shown<D>& shown, Warnings& notes) {
  std::vector<Panel> panels = B == 1 ? scalar_panels(shown, notes) : elastic_panels(shown, notes);
  std::erase_if(panels, [](const Panel& panel) { return panel.patches.empty() && panel.lines.empty(); });
  return panels;
}

}  // namespace

template <int D, int B>
std::vector<VtuField> point_fields(const Nodes<D>& nodes, const Results<D, B>& results,
                                   const std::vector<Stress>& stress, ContactFields contact) {
  std::vector<VtuField> fields;
  fields.push_back({B == 1 ? "u" : "displacement", B, nodes.at_vertices(results.u, B)});
  if constexpr (B > 1) {
    fields.push_back({"stress", 9, full_tensors(stress)});
    fields.push_back({"von_mises", 1, equivalent(stress)});
  }
  if (results.contact.obstacles.empty()) return fields;
  fields.push_back({"gap", 1, std::move(contact.gap)});
  fields.push_back({"contact_pressure", 1, std::move(contact.pressure)});
  fields.push_back({"nodal_pressure", 1, std::move(contact.nodal_pressure)});
  if (B > 1) {
    fields.push_back({"normal_traction", 3, std::move(contact.normal)});
    fields.push_back({"tangential_traction", 3, std::move(contact.tangential)});
  }
  fields.push_back({"contact", 1, std::move(contact.contact)});
  return fields;
}

std::vector<VtuField> cell_fields(const std::vector<double>& estimate) {
  if (estimate.empty()) return {};
  return {{"energy_error", 1, estimate}};
}

std::string body_suffix(std::size_t body, std::size_t bodies) { return bodies > 1 ? fmt::format("_body{}", body) : ""; }

template <int D>
void SolutionFiles::add(const Nodes<D>& nodes, const std::vector<VtuField>& fields,
                        const std::vector<VtuField>& of_elements, const Report& report, std::size_t body,
                        const VtuPacking& packing) {
  several_ = bodies_ > 1 || report.has_steps();
  const std::string step = report.has_steps() ? fmt::format("_{:03}", steps() + 1) : "";
  const std::string name = "solution" + body_suffix(body, bodies_) + step + ".vtu";
  const bool solved = report.last().summary.converged() && !(report.interrupted && !report.has_steps());
  write_vtu(files_.stage(name), nodes.mesh(), fields, of_elements, packing, nodes.order(), {{"converged", solved}});
  entries_.push_back({report.last().t, name, static_cast<int>(body)});
}

void SolutionFiles::finish() const {
  if (several_) write_pvd(files_.stage("solution.pvd"), entries_);
}

namespace {

/// Takes as many digits as there are from the front of a text; how many.
std::size_t take_digits(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const auto count = static_cast<std::size_t>(end - text.begin());
  text.remove_prefix(count);
  return count;
}

/// Takes a text from the front of another one that begins with it.
bool take(std::string_view& text, std::string_view start) {
  if (!text.starts_with(start)) return false;
  text.remove_prefix(start.size());
  return true;
}

}  // namespace

bool is_result_file(const std::string& name) {
  constexpr std::array<std::string_view, 8> fixed = {"report.json", old_report,  "solution.pvd",    "convergence.csv",
                                                     "phases.csv",  "steps.csv", "convergence.png", "steps.png"};
  if (std::find(fixed.begin(), fixed.end(), name) != fixed.end()) return true;
  std::string_view rest = name;
  const bool solution = take(rest, "solution");
  if (!solution && !take(rest, "result")) return false;
  if (take(rest, "_body") && take_digits(rest) == 0) return false;
  if (!solution) return rest == ".png";
  if (take(rest, "_") && take_digits(rest) < 3) return false;
  return rest == ".vtu";
}

namespace {

void warn_once(Report& report, Warning warning) {
  if (std::ranges::find(report.warnings, warning) == report.warnings.end())
    report.warnings.push_back(std::move(warning));
}

/// Calls draw(painter, file) for a picture of that name, or says why there is none: the other results do without.
template <class Draw>
void paint(AtomicFiles& files, const std::string& name, Report& report, const Draw& draw) {
  const std::filesystem::path file = files.stage(name);
  try {
    draw(painter(), file);
  } catch (const Error& error) {
    std::string reason = error.what();
    if (reason.starts_with(file.string())) reason.replace(0, file.string().size(), name);
    warn_once(report,
              error.status() == Exit::plugin ? warning<"no-pictures">(reason) : warning<"missing-picture">(reason));
  } catch (const std::bad_alloc&) {
    warn_once(report, warning<"missing-picture">(name + ": there is not enough memory"));
  }
}

}  // namespace

bool give_pictures_up(AtomicFiles& files, Report& report, const std::string& reason) {
  bool any = false;
  for (const auto& entry : std::filesystem::directory_iterator(files.stage("")))
    if (entry.path().extension() == ".png") {
      std::filesystem::remove(entry.path());
      warn_once(report, warning<"missing-picture">(fmt::format("{}: {}", entry.path().filename().string(), reason)));
      any = true;
    }
  return any;
}

void draw_convergence(AtomicFiles& files, Report& report) {
  paint(files, "convergence.png", report,
        [&](const Painter& draw, const auto& file) { draw.convergence(file, report.last().summary.history); });
}

template <int D, int B>
void draw_result(AtomicFiles& files, const MeshHierarchy<D>& hierarchy, const Nodes<D>& nodes,
                 const Results<D, B>& results, const std::vector<Stress>& stress, const ContactFields& contact,
                 const std::vector<int>& numbers, const std::string& suffix, Report& report) {
  paint(files, "result" + suffix + ".png", report, [&](const Painter& draw, const auto& file) {
    const auto panels =
        result_panels<D, B>(shown(hierarchy, nodes, results, stress, contact, numbers), report.warnings);
    if (!panels.empty()) draw.panels(file, panels);
  });
}

std::optional<Panel> solution_panel(Driver& driver) {
  std::optional<Panel> out;
  Warnings notes;
  for (std::size_t body = 0; body < driver.bodies(); ++body)
    driver.visit(body, [&]<int D, int B>(const BodyRun<D, B>& run) {
      const auto panels = result_panels<D, B>(
          shown(run.hierarchy(), run.nodes(), run.results(), run.stress(), contact_fields(run.nodes(), run.results()),
                numbers_of(driver.scene().obstacles, run.body())),
          notes);
      if (panels.empty() || panels.front().patches.empty()) return;
      if (!out)
        out = panels.front();
      else
        out->patches.insert(out->patches.end(), panels.front().patches.begin(), panels.front().patches.end());
    });
  return out;
}

void draw_steps(AtomicFiles& files, Report& report) {
  if (!report.has_steps()) return;
  paint(files, "steps.png", report, [&](const Painter& draw, const auto& file) {
    const std::vector<Panel> panels = steps_panels(report);
    if (!panels.empty()) draw.panels(file, panels);
  });
}

void write_tables(AtomicFiles& files, const Report& report) {
  std::vector<const Summary*> summaries;
  for (const StepReport& step : report.steps) summaries.push_back(&step.summary);
  write_text(files.stage("convergence.csv"), convergence_csv(summaries));
  write_text(files.stage("phases.csv"), phases_csv(summaries));
  if (report.has_steps()) write_text(files.stage("steps.csv"), steps_csv(report));
}

#define SIGNORINI_OUTPUT(D, B)                                                                                   \
  template ContactFields contact_fields(const Nodes<D>&, const Results<D, B>&);                                  \
  template std::vector<VtuField> point_fields(const Nodes<D>&, const Results<D, B>&, const std::vector<Stress>&, \
                                              ContactFields);                                                    \
  template void draw_result(AtomicFiles&, const MeshHierarchy<D>&, const Nodes<D>&, const Results<D, B>&,        \
                            const std::vector<Stress>&, const ContactFields&, const std::vector<int>&,           \
                            const std::string&, Report&);
SIGNORINI_OUTPUT(2, 1)
SIGNORINI_OUTPUT(3, 1)
SIGNORINI_OUTPUT(2, 2)
SIGNORINI_OUTPUT(3, 3)

template void SolutionFiles::add(const Nodes<2>&, const std::vector<VtuField>&, const std::vector<VtuField>&,
                                 const Report&, std::size_t, const VtuPacking&);
template void SolutionFiles::add(const Nodes<3>&, const std::vector<VtuField>&, const std::vector<VtuField>&,
                                 const Report&, std::size_t, const VtuPacking&);

}  // namespace signorini
