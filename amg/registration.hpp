#pragma once
#include "core/component/registry.hpp"

namespace signorini {

/// Adds the components of this folder: newton, pgs.
void register_coarse_solvers(Registry& registry);

/// Adds the direct solver: cholmod.
void register_direct_solvers(Registry& registry);

/// Adds how levels are chosen by the matrix, for `signorini list`: classical, aggregation. Nothing creates them.
void register_coarsenings(Registry& registry);

/// All smoothers, transfers, coarse and direct solvers and coarsenings: what a solve is composed from.
Registry solver_components();

}  // namespace signorini
