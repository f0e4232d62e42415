#pragma once
#include <string>
#include <vector>

#include "apps/bench/comparison.hpp"
#include "core/scene/scene.hpp"

namespace signorini::bench {

/// A scene with Coulomb friction, to be solved with any coefficient.
struct FrictionScene {
  std::string name;
  std::string file;  ///< of apps/scenes; empty: a block in the plane below, in a corner() where obstacles are two
  int obstacles = 1;
  Overrides overrides;

  /// @param more as `--set` takes them, after those of the scene
  Scene with(double friction, const Overrides& more = {}) const;
};

/// Blocks whose top is moved aside and down. Text of a vector: "[0.03, -0.03]".
FrictionScene block_2d(const std::string& name, const std::string& top, int refinements);
FrictionScene block_3d(const std::string& name, const std::string& top, int refinements);
/// A block pushed along a floor into a wall.
FrictionScene corner(int refinements);
/// The lower half of a ball, pressed on a plane and moved aside by a third of the way.
FrictionScene ball(int refinements);
/// A wedge pressed into a groove, and let go in four steps.
FrictionScene wedge(int refinements);

}  // namespace signorini::bench
