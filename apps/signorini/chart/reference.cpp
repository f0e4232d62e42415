#include "apps/signorini/chart/reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace signorini::chart {
namespace {

constexpr double told_apart = 3;  // times what the reference may be off

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double square = 0;
  for (std::size_t k = 0; k < a.size(); ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(square);
}

double as_error(const std::string& of, double off, const std::vector<double>& exact) {
  const double size = distance(exact, std::vector<double>(exact.size()));
  const double relative = size > 0 ? off / size : off;
  return of == "energy" ? std::sqrt(relative) : relative;
}

}  // namespace

double relative_error(const std::string& of, const std::vector<double>& value, const std::vector<double>& exact) {
  return as_error(of, distance(value, exact), exact);
}

double error_left(const std::string& of, const std::vector<std::vector<double>>& values) {
  constexpr double slowest = 1.5, fastest = 2.5, unknown = 2;
  const auto& last = values.back();
  double difference = distance(values[values.size() - 2], last), ratio = unknown;
  if (values.size() > 2) {
    const double before = distance(values[values.size() - 3], values[values.size() - 2]);
    difference = std::max(difference, before / fastest);
    if (difference > 0) ratio = std::max(slowest, before / difference);
  }
  return as_error(of, difference / (ratio - 1), last);
}

Reference reference(const ChartArguments& arguments, const std::vector<Setting>& settings,
                    const std::vector<Run>& all) {
  if (all.empty()) throw Error(Exit::input, "no setting has solved the scene in time; see the omissions");
  if (!arguments.exact.empty()) {
    if (arguments.exact.size() != all.front().value.size())
      throw Error(Exit::usage, fmt::format("--exact: found {} numbers, expected {}, as many as the {} has",
                                           arguments.exact.size(), all.front().value.size(), arguments.of));
    return {arguments.exact, 0, "the exact value"};
  }
  std::vector<const Run*> first;
  for (const Run& run : all)
    if (run.setting == 0) first.push_back(&run);
  if (first.size() < 3)
    throw Error(Exit::input, fmt::format("only {} runs with {} were ready in time, expected at least 3, the last of "
                                         "them to compare with; expected more --seconds, or the value by --exact",
                                         first.size(), settings.front().name));
  std::vector<std::vector<double>> values;
  for (const Run* run : first) values.push_back(run->value);
  Reference out{values.back(), error_left(arguments.of, values), {}};
  out.text = fmt::format("{}, {} ({:.0f} unknowns), which is off by about {:.1e} itself", settings.front().name,
                         first.back()->keys.back(), first.back()->unknowns, out.uncertain);
  return out;
}

void compare(const std::string& of, const Reference& with, std::vector<Run>& all) {
  for (Run& run : all) {
    const double error = relative_error(of, run.value, with.value);
    if (error > told_apart * with.uncertain) run.error = error;
  }
}

}  // namespace signorini::chart
