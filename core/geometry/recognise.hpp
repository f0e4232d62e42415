#pragma once
#include <optional>
#include <span>

#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// A shape, and how far the points are off it at most.
template <int D>
struct Recognised {
  Curve<D> curve;
  double deviation;
};

/// The circle (D = 2), or the cylinder, cone, sphere or torus (D = 3), that is nearest to points in the sense of least
/// squares: the first one in this order that all points are on within `rounding`, else the one with the least
/// deviation. Nothing where that is above `tolerance`, or where there are not more points than the shape has numbers.
/// @param normals of the surface at the points, unit vectors of either sign, within some degrees
template <int D>
std::optional<Recognised<D>> recognise(std::span<const Point<D>> points, std::span<const Point<D>> normals,
                                       double rounding, double tolerance);

}  // namespace signorini::geometry
