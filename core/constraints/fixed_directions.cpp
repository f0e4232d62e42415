#include "core/constraints/fixed_directions.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/local_basis.hpp"
#include "core/base/rounding.hpp"
#include "core/sdk/block.hpp"

namespace signorini {
namespace {

constexpr double axis_rounding = rounding_of_differences;

// Replaces a unit vector within rounding of a coordinate axis by that axis.
template <int B>
void snap_to_axis(double* d) {
  const int largest =
      static_cast<int>(std::max_element(d, d + B, [](double a, double b) { return std::fabs(a) < std::fabs(b); }) - d);
  for (int i = 0; i < B; ++i)
    if (i != largest && std::fabs(d[i]) > axis_rounding) return;
  for (int i = 0; i < B; ++i) d[i] = i == largest ? std::copysign(1.0, d[i]) : 0.0;
}

}  // namespace

template <int B>
typename FixedDirections<B>::Found FixedDirections<B>::add(const double* d, double v0, Index number) {
  double rest[B], rest_value = v0, most = 0;
  Index other = -1;
  std::copy_n(d, B, rest);
  for (int k = 0; k < count; ++k) {
    const double c = block::dot<B>(direction[k], rest);
    for (int i = 0; i < B; ++i) rest[i] -= c * direction[k][i];
    rest_value -= c * value[k];
    if (std::fabs(c) > most) other = fix[k];
    most = std::max(most, std::fabs(c));
  }
  const double length = block::norm<B>(rest);
  if (length < same_direction || count == B) return {other, std::fabs(rest_value)};
  for (int i = 0; i < B; ++i) direction[count][i] = rest[i] / length;
  snap_to_axis<B>(direction[count]);
  fix[count] = number;
  value[count++] = rest_value / length;
  return {};
}

template <int B>
void FixedDirections<B>::hold_rest(Index number) {
  for (int i = 0; i < B && count < B; ++i) {
    double axis[B] = {}, prescribed = 0;
    axis[i] = 1;
    for (int k = 0; k < count; ++k) prescribed += direction[k][i] * value[k];
    add(axis, prescribed, number);
  }
}

template <int B>
bool FixedDirections<B>::along_axes() const {
  for (int k = 0; k < count; ++k)
    if (std::count(direction[k], direction[k] + B, 0.0) != B - 1) return false;
  return true;
}

template struct FixedDirections<1>;
template struct FixedDirections<2>;
template struct FixedDirections<3>;

}  // namespace signorini
