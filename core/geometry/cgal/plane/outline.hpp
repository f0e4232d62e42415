#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/cgal/sizing.hpp"
#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// One straight or curved side of a region in the plane.
struct Side {
  Point<2> from, to;
  bool curved;       ///< an arc of Outline::circle, counterclockwise; all of it where `from` and `to` agree
  std::string part;  ///< "" for none
};

/// A region in the plane bounded by sides, counterclockwise.
struct Outline {
  std::string shape;  ///< for messages
  std::vector<Side> sides;
  std::optional<Curve<2>> circle;
  double diameter = 0;
  double coarsest_size = infinity;  ///< the largest size that still resolves the shape
  std::string narrowest;            ///< says where that is, for messages
};

/// Errors are ShapeError: a radius that is not positive, less than three points, repeated points, sides that
/// meet or cross, no area. Polygons may be given clockwise.
Outline outline(const Shape2& shape);

/// Points along a side from its start to before its end, spaced evenly relative to the size.
std::vector<Point<2>> divide(const Outline& outline, const Side& side, const Sizing<2>& size);

}  // namespace signorini::geometry
