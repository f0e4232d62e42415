#pragma once
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Whether an interpolation has no kinks, like that of B-splines: what a coarse vector has is then not the value at its
/// twin, nearly all of which have weights of others, too.
inline bool is_smooth(const Prolongation& P) {
  constexpr Index of_ten = 9;
  if (P.twin.empty() || !P.block.empty()) return false;
  Index twins = 0, mixed = 0;
  for (const Index p : P.twin) {
    if (p < 0) continue;
    ++twins;
    mixed += P.row[p + 1] - P.row[p] > 1;
  }
  return mixed > 0 && 10 * Offset{mixed} >= of_ten * Offset{twins};
}

}  // namespace signorini
