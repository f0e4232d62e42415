#pragma once
#include <optional>
#include <span>

#include "core/mesh/mesh.hpp"
#include "core/mesh/simplex.hpp"

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

/// Whether a corner of a face of a cone is its tip, where the cone has no normal.
/// @param size the length of an edge that ends there
template <int D>
bool is_tip(const Curve<D>& curve, const Point<D>& p, double size) {
  constexpr double near = 1e-3;  // of the edge
  return curve.kind == CurveKind::cone && length<D>(difference<D>(p, curve.center)) <= near * size;
}

}  // namespace signorini::geometry
