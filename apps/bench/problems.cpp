#include "apps/bench/problems.hpp"

#include "amg/registration.hpp"

namespace signorini::bench {

Problem::Problem(std::string title, const std::string& file, std::vector<std::string> overrides)
    : name(std::move(title)),
      scene(read_scene(std::filesystem::path(SIGNORINI_SCENES) / file, overrides)),
      registry(solver_components()) {
  load_plugins(scene, registry);
}

}  // namespace signorini::bench
