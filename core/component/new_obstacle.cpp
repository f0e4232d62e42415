#include "core/component/new_obstacle.hpp"

#include <fmt/format.h>

#include <type_traits>

#include "core/base/error.hpp"
#include "core/component/failure.hpp"
#include "core/component/settings.hpp"
#include "core/sdk/obstacle.hpp"

namespace signorini {
namespace {

/// @param plugin where messages begin
void check_descriptor(const ObstacleDescriptor& descriptor, int block, const std::string& plugin) {
  constexpr int most_directions = std::extent_v<decltype(descriptor.direction)>;
  const auto refuse = [&](const std::string& what) { throw Error(Exit::plugin, plugin + " " + what); };
  if (const int found = descriptor.directions; found < 0 || found > most_directions)
    refuse(fmt::format("describes {} directions, expected 0 to {}", found, most_directions));
  if (const int found = descriptor.data; found < 0 || found > most_data)
    refuse(fmt::format("has {} numbers of its own, expected 0 to {}", found, most_data));
  for (int k = 0; k < descriptor.directions; ++k) {
    const auto& [name, components, values] = descriptor.direction[k];
    if (!name || !*name) refuse(fmt::format("describes direction {} without a name", k));
    if (components < 1 || components > block)
      refuse(fmt::format("describes {} components of '{}', expected 1 to {}", components, name, block));
    if (values < 1) refuse(fmt::format("describes {} values of '{}', expected at least 1", values, name));
  }
}

}  // namespace

std::string failed_call(const Status& status, const std::string& origin, const Entry& entry, const char* call) {
  if (!is_fault_of_plugin(status)) return origin;
  return fmt::format("{}: {}: the {} of '{}' failed", origin, entry.file, call, entry.id);
}

template <int B>
std::shared_ptr<Obstacle<B>> new_obstacle(const ObstacleType& type, const Entry& entry,
                                          std::shared_ptr<const Settings> settings, const std::string& origin) {
  Status status;
  std::unique_ptr<Obstacle<B>> obstacle(constructor<B>(type)(*settings, status));
  check_asked(*settings, origin);  // first: what it then complains about may be due to it
  if (!status.ok()) throw_failure(status, failed_call(status, origin, entry, "constructor"));
  if (!obstacle) throw Error(Exit::plugin, fmt::format("{}: the plugin of '{}' made no obstacle", origin, entry.id));
  check_descriptor(obstacle->descriptor(), B, fmt::format("{}: the plugin of '{}'", origin, entry.id));
  if (obstacle->functional() && !obstacle->linearisation())
    throw Error(Exit::plugin,
                fmt::format("{}: the plugin of '{}' has a functional without its linearisation", origin, entry.id));
  return {obstacle.release(), [settings](const Obstacle<B>* held) { delete held; }};
}

#define SIGNORINI_INSTANTIATE(B)                                                        \
  template std::shared_ptr<Obstacle<B>> new_obstacle(const ObstacleType&, const Entry&, \
                                                     std::shared_ptr<const Settings>, const std::string&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
