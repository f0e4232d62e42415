#pragma once
#include <algorithm>
#include <cmath>

#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// A shape in units of its own extent, so that its mesh does not depend on the user's units.
template <class Shape>
struct UnitShape {
  double unit;
  Shape shape;
};

template <class Shape>
requires requires(Shape s) { s.radius; }
UnitShape<Shape> unit_shape(Shape shape) {
  const double unit = shape.radius;
  for (double& x : shape.center) x /= unit;
  shape.radius = 1;
  if constexpr (requires { shape.height; }) shape.height /= unit;
  return {unit, shape};
}

inline UnitShape<Polygon> unit_shape(Polygon polygon) {
  double unit = 0;
  for (const auto& p : polygon.points)
    for (int i = 0; i < 2; ++i) unit = std::max(unit, std::abs(p[i] - polygon.points.front()[i]));
  if (!(unit > 0)) return {1, std::move(polygon)};
  for (auto& p : polygon.points)
    for (double& x : p) x /= unit;
  return {unit, std::move(polygon)};
}

template <int D>
void scale(Mesh<D>& mesh, double unit) {
  for (auto& p : mesh.points)
    for (double& x : p) x *= unit;
  for (Curve<D>& curve : mesh.curves) {
    for (double& x : curve.center) x *= unit;
    curve.radius *= unit;
  }
}

}  // namespace signorini::geometry
