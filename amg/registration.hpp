#pragma once
#include "core/component/registry.hpp"

namespace signorini {

/// Adds the components of this folder: newton, pgs.
void register_coarse_solvers(Registry& registry);

/// Adds the direct solver: cholmod.
void register_direct_solvers(Registry& registry);

/// All smoothers, transfers, coarse and direct solvers: what a solve is composed from.
Registry solver_components();

}  // namespace signorini
