#pragma once
#include <array>

#include "core/scene/scene.hpp"

namespace signorini {

/// The point of a rigid obstacle at the step parameter t that moments of its force are about, its third coordinate zero
/// in 2D: the `point` of a plane, the `center` of a sphere or a cylinder, else the origin. A coordinate that is an
/// expression in space is taken at the origin; where it has no value there, the origin is the point.
std::array<double, 3> reference_point(const Scene::Obstacle& obstacle, double t);

}  // namespace signorini
