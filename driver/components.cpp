#include "driver/components.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/component/plugin_loader.hpp"
#include "methods/configuration.hpp"

namespace signorini {

std::vector<PluginReport> load_plugins(const Scene& scene, Registry& registry) {
  PluginLoader loader(registry, scene.plugin_path);
  std::vector<PluginReport> plugins;
  for (const auto& obstacle : scene.obstacles) {
    const auto same = [&](const PluginReport& plugin) { return plugin.id == obstacle.type; };
    if (std::any_of(plugins.begin(), plugins.end(), same)) continue;
    try {
      loader.require(obstacle.type);
    } catch (const Error& error) {
      throw Error(error.status(), obstacle.source.of("type") + ": " + error.what());
    }
    const Entry& entry = registry.entry("obstacle", obstacle.type);
    plugins.push_back({entry.id, entry.file, entry.version});
  }
  return plugins;
}

/// What the solver refuses of its options it names by key only, "solver.transfer: ...": that is completed by the place.
void check_components(const Scene& scene, const Registry& registry) {
  try {
    check_options(scene.solver);
    check_components(static_cast<const SolverOptions&>(scene.solver), registry);
  } catch (const Error& error) {
    const std::string message = error.what();
    for (const auto& [key, place] : scene.solver.source.keys)
      if (const std::string start = "solver." + key + ": "; message.starts_with(start))
        input_error(place, message.substr(start.size()));
    input_error(scene.file.string(), message);
  }
}

}  // namespace signorini
