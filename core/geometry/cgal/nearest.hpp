#pragma once
#include <array>

#include "core/base/types.hpp"

namespace signorini::geometry {

/// The point of a triangle nearest to another point, as weights of the corners; a weight is exactly zero unless the
/// point is off the opposite edge. C. Ericson, Real-Time Collision Detection, 5.1.5.
std::array<double, 3> nearest_weights(const Point<3>& p, const std::array<Point<3>, 3>& corner);

}  // namespace signorini::geometry
