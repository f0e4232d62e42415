#pragma once
#include <cstdint>
#include <vector>

#include "amg/black_box/block_obstacle.hpp"
#include "c/signorini.h"

namespace signorini {

/// Obstacles of a caller of C, for blocks of B.
/// @throws Error(Exit::input) naming the obstacle and what was expected
template <int B>
std::vector<BlockObstacle<B>> obstacles_from_c(std::int32_t count, const signorini_obstacle* const* given);

}  // namespace signorini
