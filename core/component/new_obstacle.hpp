#pragma once
#include <memory>
#include <string>

#include "core/component/registry.hpp"

namespace signorini {

/// The type's constructor for B unknowns per vector; null where it has none.
template <int B>
auto constructor(const ObstacleType& type) {
  if constexpr (B == 1) return type.create1;
  if constexpr (B == 2) return type.create2;
  if constexpr (B == 3) return type.create3;
}

/// Where a call of an obstacle failed: a fault of the plugin is told with its file.
/// @param origin of the obstacle
/// @param call "constructor"...
std::string failed_call(const Status& status, const std::string& origin, const Entry& entry, const char* call);

/// A new obstacle of a type that has a constructor for B, which keeps the settings that it holds on to. What the
/// constructor complains about is an Error with its status, an obstacle that contradicts itself an Error(Exit::plugin).
/// @param entry of the type
/// @param origin of the obstacle, for messages: "scene.toml:12: obstacle.0"
template <int B>
std::shared_ptr<Obstacle<B>> new_obstacle(const ObstacleType& type, const Entry& entry,
                                          std::shared_ptr<const Settings> settings, const std::string& origin);

}  // namespace signorini
