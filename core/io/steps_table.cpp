#include "core/io/steps_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace signorini {
namespace {

/// A text that commas, quotes and line breaks do not end.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  return out + '"';
}

/// One line of a table.
class Row {
 public:
  Row& text(const std::string& value) {
    cells_.push_back(quoted(value));
    return *this;
  }
  Row& number(double value) {
    cells_.push_back(std::isfinite(value) ? fmt::format("{}", value) : "");
    return *this;
  }
  /// As many cells as a vector may have entries; what it lacks stays empty.
  Row& vector(const std::vector<double>& values, std::size_t cells) {
    for (std::size_t k = 0; k < cells; ++k)
      if (k < values.size())
        number(values[k]);
      else
        text("");
    return *this;
  }
  Row& names(const std::string& name, std::size_t cells) {
    for (std::size_t k = 0; k < cells; ++k) text(fmt::format("{}_{}", name, "xyz"[k]));
    return *this;
  }
  std::string line() const { return fmt::format("{}\n", fmt::join(cells_, ",")); }

 private:
  std::vector<std::string> cells_;
};

std::string heading(const Report& report, std::size_t dimension) {
  Row row;
  for (const char* name : {"step", "t", "converged", "obstacle", "nodes", "open_nodes", "slip_nodes", "stick_nodes"})
    row.text(name);
  row.names("normal_force", dimension).names("tangential_force", dimension);
  if (dimension == 2)
    row.text("moment_z");
  else
    row.names("moment", dimension);
  row.names("moment_about", dimension).text("dissipated_in_step").text("dissipated");
  row.names("displacement", dimension).names("motion", dimension);
  for (const ProbeReport& probe : report.last().probes) row.names(probe.name, dimension);
  return row.line();
}

std::string line(const StepReport& step, const ContactReport& contact, std::size_t dimension) {
  Row row;
  row.number(step.step).number(step.t).number(step.summary.converged()).number(contact.obstacle);
  row.number(contact.nodes).number(contact.open_nodes).number(contact.slip_nodes).number(contact.stick_nodes);
  row.vector(contact.normal_force, dimension).vector(contact.tangential_force, dimension);
  row.vector(contact.moment, dimension == 2 ? 1 : 3).vector(contact.moment_about, dimension);
  row.number(contact.dissipated_in_step).number(contact.dissipated).vector(contact.displacement, dimension);
  row.vector(contact.motion, dimension);
  for (const ProbeReport& probe : step.probes)
    row.vector(probe.body == contact.body ? probe.value : std::vector<double>(), dimension);
  return row.line();
}

}  // namespace

std::string steps_csv(const Report& report) {
  const auto dimension = static_cast<std::size_t>(report.dimension);
  std::string table = heading(report, dimension);
  for (const StepReport& step : report.steps)
    for (const ContactReport& contact : step.contact) table += line(step, contact, dimension);
  return table;
}

}  // namespace signorini
