#pragma once
#include <vector>

#include "core/solver/discrete_problem.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Whether the vector x of a slot with a functional is where it was after the last load step, along the obstacle.
/// @param x B numbers, in local coordinates
template <int B>
bool sticks(const Constraints<B>& c, Index slot, const double* x) {
  if (c.tangential.empty() || c.tangential[slot] == 0) return false;
  for (int k = 0; k < B; ++k)
    if (c.tangential[slot] >> k & 1u && x[k] != c.last[Offset{slot} * B + k]) return false;
  return true;
}

/// Lets vectors of a start on the finer level stick where all of the coarse slots stick that they are interpolated
/// from. Interpolation makes them slip a little, and cycles would find the way back from the edge of what sticks
/// inwards only, a few layers each.
/// @param x_coarse a solution, x its interpolation: B per vector, in local coordinates
template <int B>
void stick_between(const DiscreteProblem<B>& coarse, const std::vector<double>& x_coarse, const Prolongation& P,
                   const DiscreteProblem<B>& fine, std::vector<double>& x) {
  const Constraints<B>&above = fine.constraints, &below = coarse.constraints;
  if (above.tangential.empty() || below.tangential.empty()) return;
  for (Index slot = 0; slot < above.size(); ++slot) {
    const Index p = above.vector[slot];
    bool any = false, all = true;
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
      const Index q = P.column[k], s = below.slot[q];
      if (s < 0) continue;
      any = true;
      all = all && sticks(below, s, x_coarse.data() + Offset{q} * B);
    }
    for (int k = 0; any && all && k < B; ++k)
      if (above.tangential[slot] >> k & 1u) x[Offset{p} * B + k] = above.last[Offset{slot} * B + k];
  }
}

}  // namespace signorini
