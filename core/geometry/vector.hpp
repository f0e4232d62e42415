#pragma once
#include <cmath>

#include "core/base/types.hpp"

namespace signorini::geometry {

inline double norm(const Point<3>& a) { return std::hypot(a[0], a[1], a[2]); }
inline Point<3> scaled(double s, const Point<3>& a) { return {s * a[0], s * a[1], s * a[2]}; }
/// a + s b
inline Point<3> plus(const Point<3>& a, double s, const Point<3>& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
inline Point<3> minus(const Point<3>& a, const Point<3>& b) { return plus(a, -1, b); }

}  // namespace signorini::geometry
