#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/types.hpp"

namespace signorini::geometry {

/// Binary digits that numbers are rounded to before a mesher sees them. Changes of units change the last digits of a
/// double, and mesh generation amplifies them to another mesh; rounded, the numbers are the same in (almost) all units.
/// "Almost" is once in 2^(50 - digits) numbers, hence fewer digits where there are more numbers.
inline constexpr int shape_digits = 40, surface_digits = 32;

/// The number with so many significant binary digits.
inline double rounded(double x, int digits) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return std::ldexp(std::round(std::ldexp(fraction, digits)), exponent - digits);
}

/// Coordinates of its own that a shape is meshed in: about 1 in size and at the origin, wherever it is and in whatever
/// units.
template <int D>
struct OwnUnits {
  Point<D> origin{};
  double unit = 1;

  Point<D> given(Point<D> own) const {
    for (int k = 0; k < D; ++k) own[k] = origin[k] + unit * own[k];
    return own;
  }
  /// Rounded to so many binary digits after the point.
  Point<D> own(Point<D> given, int digits) const {
    for (int k = 0; k < D; ++k)
      given[k] = std::ldexp(std::round(std::ldexp((given[k] - origin[k]) / unit, digits)), -digits);
    return given;
  }
};

/// Those of the box around some points: its low corner and its longest edge.
template <int D, class Points>
OwnUnits<D> own_units(const Points& points) {
  Point<D> low = points.front(), high = low;
  for (const Point<D>& p : points)
    for (int k = 0; k < D; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  double unit = 0;
  for (int k = 0; k < D; ++k) unit = std::max(unit, high[k] - low[k]);
  return {low, unit > 0 ? unit : 1};
}

}  // namespace signorini::geometry
