#include "amg/obstacle_by_name.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/base/error.hpp"
#include "core/component/failure.hpp"
#include "core/component/new_obstacle.hpp"
#include "core/component/plugin_loader.hpp"
#include "core/component/settings.hpp"

namespace signorini {

template <int B>
std::shared_ptr<const Obstacle<B>> obstacle_by_name(const std::string& id, std::span<const std::string> options,
                                                    std::shared_ptr<const DistanceFunction> shape,
                                                    std::vector<std::filesystem::path> folders, const LoadStep& step) {
  Registry registry;
  PluginLoader(registry, std::move(folders)).require(id);
  const ObstacleType& type = registry.obstacle(id);
  const Entry& entry = registry.entry("obstacle", id);
  const std::string origin = fmt::format("obstacle '{}'", id);
  if (!constructor<B>(type)) input_error(origin, fmt::format("knows no blocks of {} unknowns", B));
  if (shape && !type.takes_shape) input_error(origin, "takes no shape");
  const std::span specs(type.options, type.option_count);
  auto settings = compile_settings(origin, specs, table_of(origin, specs, options), {}, std::move(shape), step.to);
  std::shared_ptr<Obstacle<B>> out = new_obstacle<B>(type, entry, settings, origin);
  if (auto* stepping = dynamic_cast<Stepping*>(out.get())) {
    Status status;
    stepping->begin(step, status);
    if (!status.ok()) throw_failure(status, failed_call(status, origin, entry, "beginning of a step"));
  }
  return out;
}

#define SIGNORINI_INSTANTIATE(B)                                                                 \
  template std::shared_ptr<const Obstacle<B>> obstacle_by_name<B>(                               \
      const std::string&, std::span<const std::string>, std::shared_ptr<const DistanceFunction>, \
      std::vector<std::filesystem::path>, const LoadStep&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
