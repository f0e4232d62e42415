#pragma once
#include <string>
#include <vector>

#include "core/base/types.hpp"

namespace signorini::geometry {

/// Throws ShapeError unless the points are at least three, finite, distinct, and bound an area by sides that meet at
/// their ends only. Returns whether they run clockwise.
bool check_polygon(const std::vector<Point<2>>& points);

/// "points[2] is 1e-9 away from edge0": where a polygon is narrowest, for messages; "" when it has very many corners.
std::string narrowest_place(const std::vector<Point<2>>& points);

}  // namespace signorini::geometry
