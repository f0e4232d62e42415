#pragma once
#include <vector>

#include "amg/coarsening/aggregates.hpp"
#include "core/algebra/block_matrix.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Interpolation from a coarser level chosen by the matrix alone: piecewise constant on aggregates, smoothed by a
/// damped Jacobi step with the strong couplings (Vanek, Mandel, Brezina, Computing 56, 1996); in blocks the norms of
/// the couplings stand for them, so that the weights are the same for all components. Weights are positive; those of a
/// row sum to one, or to less where a scalar matrix says that constants have energy. The twin of a coarse vector is the
/// root of its aggregate.
/// @param off components prescribed; vectors without any other one take no part
template <int B>
Prolongation smoothed_aggregation(const BlockMatrix<B>& A, const std::vector<Flags>& off,
                                  const Aggregator& aggregator = GreedyAggregator());

}  // namespace signorini
