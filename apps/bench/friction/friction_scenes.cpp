#include "apps/bench/friction/friction_scenes.hpp"

#include <fmt/format.h>

#include "apps/bench/problems.hpp"
#include "apps/scenes/tables.hpp"

namespace signorini::bench {
namespace {

// The block of block_with_coulomb_friction_3d.toml in the plane.
const std::string plane_block = tables::block("block", "[0, 0]", "[2, 1]", "[4, 2]") +
                                tables::fix("block", "top", "[0.01, -0.03]") +
                                "[[obstacle]]\ntype = \"coulomb\"\nfriction = 0.3\nbody = \"block\"\non = \"bottom\"\n"
                                "shape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\n";

// Pushed along a floor into a wall that leans and moves.
const std::string corner_block =
    tables::block("block", "[0, 0]", "[1, 1]", "[4, 4]") + tables::fix("block", "top", "[\"0.1*t\", -0.05]") +
    "[[obstacle]]\ntype = \"coulomb\"\nfriction = 0.3\nbody = \"block\"\nwhere = \"y == 0 && x <= 0.5\"\n"
    "shape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\n"
    "[[obstacle]]\ntype = \"coulomb\"\nfriction = 0.3\nbody = \"block\"\nwhere = \"x == 1 && y >= 0.25 && y <= 0.75\"\n"
    "shape = \"plane\"\npoint = [\"1.02 - 0.03*t\", \"0.1*t\"]\nnormal = [-1, 0.05]\n";

std::string refined(int refinements) { return fmt::format("refine.uniform={}", refinements); }

}  // namespace

Scene FrictionScene::with(double friction, const Overrides& more) const {
  Overrides all = joined(overrides, more);
  for (int k = 0; k < obstacles; ++k) all.push_back(fmt::format("obstacle.{}.friction={}", k, friction));
  if (!file.empty()) return linear_scene(file, std::move(all));
  return parse_scene(obstacles == 1 ? plane_block : corner_block, "block.toml", ".", all);
}

FrictionScene block_2d(const std::string& name, const std::string& top, int refinements) {
  return {name, "", 1, {"fix.0.value=" + top, refined(refinements)}};
}

FrictionScene corner(int refinements) { return {"floor and wall", "", 2, {refined(refinements)}}; }

FrictionScene block_3d(const std::string& name, const std::string& top, int refinements) {
  return {name, "block_with_coulomb_friction_3d.toml", 1, {"fix.0.value=" + top, refined(refinements)}};
}

FrictionScene ball(int refinements) {
  return {"ball",
          "ball_on_plane.toml",
          1,
          {"obstacle.0.type=\"coulomb\"", "fix.0.value=[0.004, 0, -0.011]", refined(refinements)}};
}

FrictionScene wedge(int refinements) { return {"wedge", "wedge_in_groove_2d.toml", 2, {refined(refinements)}}; }

}  // namespace signorini::bench
