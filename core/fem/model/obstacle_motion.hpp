#pragma once
#include <array>

#include "core/fem/model/model.hpp"

namespace signorini {

/// How far the rigid obstacle has moved since the last load step at a vertex: what it would drag along that sticks to
/// it. From one place to the other it turns the shortest way. Zero where the last step is not known.
template <int B>
std::array<double, B> obstacle_motion(const ObstacleTerm<B>& term, const SurfaceVertex& vertex, Status& status);

}  // namespace signorini
