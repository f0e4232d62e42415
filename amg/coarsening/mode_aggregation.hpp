#pragma once
#include "amg/coarsening/aggregates.hpp"
#include "core/algebra/near_null_space.hpp"
#include "core/solver/level.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// A level with what is known of it, while levels are chosen from fine to coarse.
struct ModeAggregation {
  Prolongation prolongation;
  NearNullSpace coarse;  ///< of the coarse level
  Index group = 1;       ///< of its consecutive vectors that belong to one aggregate
};

/// Smoothed aggregation that represents a near null space exactly, on every level (Vanek, Mandel, Brezina, Computing
/// 56, 1996): the tentative interpolation of its modes from aggregates, smoothed by a damped step of the Jacobi method
/// with the diagonal blocks. An aggregate has as many coarse vectors as its modes fill; weights are blocks (scalars for
/// B = 1). The first of these vectors has the values of the root of the aggregate, its twin, where
/// that is not held and represents the aggregate well.
/// @param level its matrix and prescribed components; phases cleared
/// @param fine the near null space on it, in global coordinates
/// @param group of its consecutive vectors that belong to one node
/// @param stretched its cells are: couplings have to be strong at both ends
template <int B>
ModeAggregation mode_aggregation(const Level<B>& level, const NearNullSpace& fine, Index group,
                                 const Aggregator& aggregator = GreedyAggregator(), bool stretched = false);

}  // namespace signorini
