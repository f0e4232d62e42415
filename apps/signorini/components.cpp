#include "apps/signorini/components.hpp"

#include <algorithm>

#include "amg/registration.hpp"
#include "core/base/error.hpp"
#include "core/component/plugin_loader.hpp"
#include "smoothers/registration.hpp"
#include "transfer/registration.hpp"

namespace signorini {

Registry own_components() {
  Registry registry;
  register_smoothers(registry);
  register_transfers(registry);
  register_coarse_solvers(registry);
  return registry;
}

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

}  // namespace signorini
