#include "driver/components.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "amg/registration.hpp"
#include "core/base/error.hpp"
#include "core/base/own_name.hpp"
#include "core/component/plugin_loader.hpp"
#include "core/scene/specs.hpp"
#include "estimators/registration.hpp"
#include "methods/configuration.hpp"

namespace signorini {
namespace {

bool has_option(const Entry& entry, std::string_view name) {
  return std::ranges::any_of(entry.options, [&](const OptionSpec& option) { return name == option.name; });
}

/// Refuses an option that the type of an obstacle has not and others have, naming these: those that act between two
/// bodies, or against a rigid shape, as this one does.
void refuse_options_of_others(const Scene::Obstacle& obstacle, Registry& registry, PluginLoader& loader) {
  const Entry own = registry.entry("obstacle", obstacle.type);
  for (const auto& [key, raw] : obstacle.options.entries) {
    const std::string_view meant = own_name(key);
    if (has_option(own, key) || has_option(own, meant)) continue;
    const bool acts_on_body = registry.obstacle(obstacle.type).takes_body;
    std::vector<std::string> types;
    loader.load_all();  // what follows is an error anyway, here or later
    for (const Entry& other : registry.entries("obstacle"))
      if (registry.obstacle(other.id).takes_body == acts_on_body &&
          (has_option(other, key) || has_option(other, meant)))
        types.push_back(fmt::format("'{}'", other.id));
    if (!types.empty())
      input_error(raw.origin, fmt::format("obstacle '{}' has no option '{}', {} of {} {}", obstacle.type, key,
                                          meant.empty() ? "which is one" : fmt::format("'{}' is one", meant),
                                          types.size() > 1 ? "the types" : "type", fmt::join(types, ", ")));
  }
}

}  // namespace

Registry all_components() {
  Registry registry = solver_components();
  register_estimators(registry);
  return registry;
}

std::vector<PluginReport> load_plugins(const Scene& scene, Registry& registry) {
  PluginLoader loader(registry, scene.plugin_path);
  std::vector<PluginReport> plugins;
  for (const auto& obstacle : scene.obstacles) {
    try {
      loader.require(obstacle.type);
    } catch (const Error& error) {
      throw Error(error.status(), obstacle.source.of("type") + ": " + error.what());
    }
    refuse_options_of_others(obstacle, registry, loader);
    const auto same = [&](const PluginReport& plugin) { return plugin.id == obstacle.type; };
    if (std::any_of(plugins.begin(), plugins.end(), same)) continue;
    const Entry& entry = registry.entry("obstacle", obstacle.type);
    plugins.push_back({entry.id, entry.file, entry.version});
  }
  if (const std::string estimator = scene.estimator(); !registry.has("estimator", estimator) && !estimator.empty())
    try {
      loader.require(estimator, "estimator");
    } catch (const Error& error) {
      throw Error(error.status(), scene.solver.source.of("estimate") + ": " + error.what());
    }
  if (scene.refine.adaptive) loader.require("recovery", "estimator");  // where there are no bounds
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
