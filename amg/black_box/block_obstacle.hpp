#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/sdk/obstacle.hpp"

namespace signorini {

/// An obstacle and the blocks of a matrix that it acts on, such as the displacements of the nodes of a surface. Several
/// obstacles may act on one block: what is admissible there is the polyhedron of all their bounds. One of them may have
/// an energy of its own, such as friction.
/// @tparam B the unknowns of a block: 1, 2 or 3
template <int B>
struct BlockObstacle {
  std::shared_ptr<const Obstacle<B>> obstacle;  ///< of a plugin, see obstacle_by_name(), or of the caller's own
  std::vector<Index> blocks;  ///< their numbers from 0, ascending: block p is rows p * B to p * B + B - 1
  /// One for each block, in the caller's unit of length: the position, the outer unit normal where the obstacle asks
  /// for it (zero: none), and the measure, which it asks for where it has an energy. `vertex` becomes the block.
  std::vector<SurfaceVertex> places;
  std::string name = "obstacle";  ///< for messages
};

}  // namespace signorini
