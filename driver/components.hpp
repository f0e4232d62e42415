#pragma once
#include "core/component/registry.hpp"
#include "core/io/report.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// Solver components and estimators.
Registry all_components();

/// Loads the plugins of the obstacles that a scene names, and says which file each came from.
std::vector<PluginReport> load_plugins(const Scene& scene, Registry& registry);

/// Error(Exit::input) at the key of [solver] that names no registered component.
void check_components(const Scene& scene, const Registry& registry);

}  // namespace signorini
