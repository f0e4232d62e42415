#pragma once
#include <vector>

#include "core/base/types.hpp"

namespace signorini::geometry {

/// Throws Error(Exit::input) unless the points are at least three, finite, distinct, and bound an area by sides that
/// meet at their ends only. Returns whether they run clockwise.
bool check_polygon(const std::vector<Point<2>>& points);

}  // namespace signorini::geometry
