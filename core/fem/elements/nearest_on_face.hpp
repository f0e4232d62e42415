#pragma once
#include <algorithm>
#include <array>

#include "core/base/dot.hpp"
#include "core/fem/elements/element.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {

template <int D>
Point<D> nearest_on_segment(const Point<D>& a, const Point<D>& b, const Point<D>& x) {
  const Point<D> ab = difference<D>(b, a);
  const double s = std::clamp(dot(difference<D>(x, a), ab) / dot(ab, ab), 0.0, 1.0);
  Point<D> out;
  for (int i = 0; i < D; ++i) out[i] = a[i] + s * ab[i];
  return out;
}

/// The point of a flat face, a segment or a triangle with an area, that is nearest to x.
inline Point<2> nearest_on_face(const std::array<Point<2>, 2>& corner, const Point<2>& x) {
  return nearest_on_segment<2>(corner[0], corner[1], x);
}

// The foot of the perpendicular when it lies inside the triangle, otherwise the nearest point of its edges.
inline Point<3> nearest_on_face(const std::array<Point<3>, 3>& corner, const Point<3>& x) {
  Point<3> n = cross(difference<3>(corner[1], corner[0]), difference<3>(corner[2], corner[0]));
  normalise(n);
  const double height = dot(difference<3>(x, corner[0]), n);
  Point<3> foot;
  for (int i = 0; i < 3; ++i) foot[i] = x[i] - height * n[i];
  bool inside = true;
  Point<3> nearest{};
  double least = infinity;
  for (int a = 0; a < 3; ++a) {
    const Point<3>&p = corner[a], &q = corner[(a + 1) % 3];
    inside = inside && dot(cross(difference<3>(q, p), difference<3>(foot, p)), n) >= 0;
    const Point<3> candidate = nearest_on_segment<3>(p, q, x);
    if (const double d = length<3>(difference<3>(candidate, x)); d < least) {
      least = d;
      nearest = candidate;
    }
  }
  return inside ? foot : nearest;
}

}  // namespace signorini
