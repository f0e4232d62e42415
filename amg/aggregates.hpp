#pragma once
#include <vector>

#include "amg/strength.hpp"

namespace signorini {

/// Disjoint sets of neighbouring vectors, each around its root.
struct Aggregates {
  std::vector<Index> of;    ///< per vector its aggregate, -1: none
  std::vector<Index> root;  ///< per aggregate, ascending

  Index size() const { return static_cast<Index>(root.size()); }
};

/// A vector with all its strong couplings, as long as these are free; then what is left joins the aggregate it is
/// coupled to most strongly, and the rest aggregates of its own (Vanek, Mandel, Brezina, Computing 56, 1996,
/// algorithm 5.1). Vectors without any coupling are in none.
Aggregates aggregate(const StrengthGraph& graph);

}  // namespace signorini
