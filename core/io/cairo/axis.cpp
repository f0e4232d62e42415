#include "core/io/cairo/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

/// The round number next to `wanted`, not below it.
double round_step(double wanted) {
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  for (const double times : {1.0, 2.0, 5.0})
    if (wanted <= times * power * (1 + 1e-9)) return times * power;
  return 10 * power;
}

double step_between(double low, double high, double step) { return std::max(step, round_step((high - low) / 8)); }

Axis marked(double low, double high, double step) {
  constexpr double rounding = 1e-6;  // of a step
  Axis axis{low, high, {}};
  for (double k = std::ceil(low / step - rounding); k * step <= high + rounding * step; ++k) {
    const double at = k * step + 0.0;  // no negative zero
    axis.ticks.push_back({at, fmt::format("{:.3g}", at), ""});
  }
  return axis;
}

/// Where there is but one value, up to rounding, some room around it.
void part(double& low, double& high) {
  constexpr double rounding = 1e-9;
  if (high - low > rounding * std::max(std::abs(low), std::abs(high))) return;
  const double room = low == 0 ? 1 : 0.1 * std::abs(low);
  low -= room;
  high += room;
}

}  // namespace

Axis linear_axis(double low, double high, double step) {
  part(low, high);
  return marked(low, high, step_between(low, high, step));
}

Axis widened_axis(double low, double high, double step) {
  part(low, high);
  step = step_between(low, high, step);
  return marked(step * std::floor(low / step + 1e-6), step * std::ceil(high / step - 1e-6), step);
}

Axis logarithmic_axis(double low, double high) {
  Axis axis{std::floor(low), std::ceil(high), {}};
  if (axis.low == axis.high) ++axis.high;
  const double step = std::ceil((axis.high - axis.low) / 10);
  for (double power = axis.low; power <= axis.high; power += step)
    axis.ticks.push_back({power, "10", fmt::format("{:.0f}", power)});
  return axis;
}

}  // namespace signorini
