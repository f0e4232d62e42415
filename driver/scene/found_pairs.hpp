#pragma once
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace signorini {

/// Two bodies that the table [contact] lets touch each other.
struct FoundPair {
  std::size_t obstacle;  ///< its number in the scene
  std::string body, other;
  double distance;  ///< least one at the start, along normals; negative where they overlap; user's unit of length
};

/// Appends an obstacle for each two bodies that [contact] says and whose surfaces on the coarsest meshes are within
/// its reach of each other, unless one of the scene's is between them; the table is gone then. The sides are the faces
/// that have the other body in front of them, and nothing else of what is found nearer.
///
/// Meshes of all these bodies are made for that, and not kept.
/// Error(Exit::input): no surfaces are within reach; and as meshes and scenes have them.
/// @param scene of read_scene()
std::vector<FoundPair> add_found_pairs(Scene& scene);

}  // namespace signorini
