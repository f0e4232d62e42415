#pragma once
#include <memory>
#include <string>

#include "core/scene/scene.hpp"
#include "core/sdk/settings.hpp"

namespace signorini {

/// The signed distance that the keys `shape`, `point`, `normal`... of an obstacle describe.
/// @param t the step parameter at which fields are evaluated
/// @param origin for messages: "scene.toml:12: obstacle.0"
std::shared_ptr<const DistanceFunction> rigid_shape(const Scene::ObstacleShape& shape, int dimension, double t,
                                                    const std::string& origin);

}  // namespace signorini
