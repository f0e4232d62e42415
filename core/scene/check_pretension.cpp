#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/scene/check_parts.hpp"

namespace signorini {

void check_pretension(const Scene& scene, const Scene::Obstacle& obstacle) {
  if (!obstacle.pretension) {
    if (obstacle.lock_at)
      input_error(obstacle.source.of("lock_at"), "'lock_at' has no meaning without 'pretension', the bolt's force");
    return;
  }
  if (scene.solver.estimate != "false" && scene.estimator() == "certificate")
    input_error(obstacle.source.of("pretension"),
                "bounds of the error are not available with pretension in this version; expected estimate = false, or "
                "recovery");
  const std::vector<double>& at = scene.steps.at;
  if (!obstacle.lock_at || at.empty()) return;
  const std::string& place = obstacle.source.of("lock_at");
  if (at.size() == 1) input_error(place, "there is one step, and none after it; expected [steps], or no 'lock_at'");
  const double first = at.front(), last = at[at.size() - 2];
  if (*obstacle.lock_at < first * (1 - rounding_of_differences) || !(*obstacle.lock_at < at.back()))
    input_error(place,
                fmt::format("{:g} is not within the steps, the first of which ends at t = {:g}, and the last but "
                            "one at {:g}; expected a t of these, or one in between",
                            *obstacle.lock_at, first, last));
}

bool Scene::Obstacle::locked(const Steps& steps, double t) const {
  if (!pretension || steps.count() < 2) return false;
  return t > lock_at.value_or(steps.at.front()) * (1 + rounding_of_differences);
}

}  // namespace signorini
