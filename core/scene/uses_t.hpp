#pragma once
#include "core/scene/scene.hpp"

namespace signorini {

/// Whether anything of a body's problem may depend on the step parameter t: its material, fixes, loads or obstacles.
bool uses_t(const Scene& scene, const Scene::Body& body);

}  // namespace signorini
