#include "apps/bench/problems.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amg/registration.hpp"
#include "core/base/error.hpp"

namespace signorini::bench {

std::filesystem::path scene_file(const std::string& name) { return std::filesystem::path(SIGNORINI_SCENES) / name; }

Scene linear_scene(const std::string& file, std::vector<std::string> overrides) {
  const bool refined = std::ranges::any_of(overrides, [](const auto& o) { return o.starts_with("refine.uniform="); });
  overrides.insert(overrides.begin(), "body.0.order=1");
  Scene scene = read_scene(scene_file(file), overrides);
  const Scene::Body& body = scene.bodies[0];
  if (!refined && body.order == 1 && body.equation == Scene::Equation::elasticity) ++scene.refine.uniform;
  return scene;
}

Problem::Problem(std::string title, const std::string& file, std::vector<std::string> overrides)
    : name(std::move(title)), scene(linear_scene(file, std::move(overrides))), registry(solver_components()) {
  load_plugins(scene, registry);
}

Problem benchmark_problem(const std::string& name, int nodes) {
  if (name != "S2" && name != "S3" && name != "E3" && name != "E3w")
    throw Error(Exit::usage, fmt::format("problem '{}' is unknown, expected S2, S3, E3 or E3w", name));
  constexpr int fewest = 4;  // cells along an edge of the coarsest mesh
  int cells = nodes - 1, uniform = 0;
  for (; cells % 2 == 0 && cells / 2 >= fewest; cells /= 2) ++uniform;
  if (uniform == 0)
    throw Error(Exit::usage, fmt::format("{} nodes: expected an odd number of at least {}", nodes, 2 * fewest + 1));
  const char* scene = name == "S2"   ? "obstacle_radial_2d.toml"
                      : name == "S3" ? "obstacle_cube_3d.toml"
                                     : "cube_on_bump.toml";
  std::vector<std::string> overrides{
      name == "S2" ? fmt::format("body.0.cells=[{0},{0}]", cells) : fmt::format("body.0.cells=[{0},{0},{0}]", cells),
      fmt::format("refine.uniform={}", uniform)};
  if (name == "E3w") overrides.push_back(flat_bump);
  return {name, scene, std::move(overrides)};
}

}  // namespace signorini::bench
