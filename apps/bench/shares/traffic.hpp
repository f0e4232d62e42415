#pragma once
#include "core/solver/multigrid.hpp"

namespace signorini::bench {

/// Bytes per second of the triad a[i] = b[i] + s c[i] on arrays far larger than the caches, one thread.
double stream_bandwidth();

/// Bytes that one V(1,1) cycle with a one-way smoother must touch: per level two sweeps and a residual, each the whole
/// matrix and its vectors, and the transfer to the next level and back.
template <int B>
double cycle_bytes(const std::vector<Level<B>>& levels, std::span<const Prolongation> prolongations);

}  // namespace signorini::bench
