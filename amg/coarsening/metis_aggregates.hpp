#pragma once
#include "amg/coarsening/aggregates.hpp"

namespace signorini {

/// As many parts as there are greedy aggregates, alike in size, between which METIS cuts little strength (Karypis,
/// Kumar, SIAM J. Sci. Comput. 20, 1998). A part in several pieces becomes as many aggregates. Roots are the vectors
/// with the fewest couplings: at the surface, where there is one. The same graph gives the same aggregates every time,
/// unless other threads draw from rand() meanwhile, as METIS does, which also seeds it.
class MetisAggregator final : public Aggregator {
 public:
  /// @throws Error(Exit::input) where the graph is too large for METIS or its memory
  Aggregates aggregate(const StrengthGraph& graph) const override;
};

}  // namespace signorini
