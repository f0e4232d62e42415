#pragma once
#include <vector>

#include "amg/coarsening/strength.hpp"

namespace signorini {

/// Disjoint sets of neighbouring vectors, each with a root in it. Vectors without any coupling are in none.
struct Aggregates {
  std::vector<Index> of;    ///< per vector its aggregate, -1: none
  std::vector<Index> root;  ///< per aggregate, ascending

  Index size() const { return static_cast<Index>(root.size()); }
};

/// A vector with all its strong couplings, as long as these are free; then what is left joins the aggregate it is
/// coupled to most strongly, and the rest aggregates of its own (Vanek, Mandel, Brezina, Computing 56, 1996,
/// algorithm 5.1).
Aggregates aggregate(const StrengthGraph& graph);

/// Moves each root to the vector of its aggregate with the fewest couplings. Aggregates at the surface of a body have
/// it there, where obstacles are: a start from coarser levels knows those of the roots alone.
/// @param of per vector its aggregate, -1: none
/// @param root per aggregate, in any order
Aggregates rooted_at_the_surface(const StrengthGraph& graph, std::vector<Index> of, std::vector<Index> root);

/// What makes aggregates; components of kind "aggregates".
class Aggregator {
 public:
  virtual ~Aggregator() = default;
  virtual Aggregates aggregate(const StrengthGraph& graph) const = 0;
};

class GreedyAggregator final : public Aggregator {
 public:
  Aggregates aggregate(const StrengthGraph& graph) const override { return signorini::aggregate(graph); }
};

}  // namespace signorini
