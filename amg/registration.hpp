#pragma once
#include <vector>

#include "core/component/registry.hpp"

namespace signorini {

/// Adds the components of this folder: newton, pgs.
void register_coarse_solvers(Registry& registry);

/// Adds what solves the linear systems of active sets: cholmod, amg_cg.
void register_linear_solvers(Registry& registry);

/// How levels are chosen by the matrix, for `signorini list`: the choices of the option `coarsening`. No components,
/// and in no registry.
std::vector<Entry> coarsenings();

/// Adds what makes the aggregates of smoothed aggregation: greedy, metis.
void register_aggregators(Registry& registry);

/// All smoothers, transfers, coarse and linear solvers and aggregators: what a solve is composed from.
Registry solver_components();

}  // namespace signorini
