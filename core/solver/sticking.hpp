#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/dot.hpp"
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

/// What is prescribed where a vector was after the last load step, but for rounding of coordinates and of the
/// obstacle's motion, rests there: rounding is no slip that all of friction is against. Of a jump that is so whatever
/// is prescribed: unless the other body goes along, friction knows nothing of it.
template <int B>
void rest_where_prescribed(DiscreteProblem<B>& problem) {
  constexpr double rounding = 1e-12;  // of the numbers that motions are differences of
  Constraints<B>& c = problem.constraints;
  if (c.tangential.empty()) return;
  const double size = std::max(max_norm(c.last), max_norm(problem.start));
  for (std::size_t slot = 0; slot < c.tangential.size(); ++slot) {
    const Index p = c.vector[slot];
    const bool jump = problem.jumps && std::ranges::binary_search(problem.jumps->vector, p);
    for (int k = 0; k < B; ++k) {
      double& last = c.last[slot * B + k];
      const double now = problem.start[Offset{p} * B + k];
      if ((problem.fixed[p] >> k & 1u) && (jump || std::abs(now - last) <= rounding * size)) last = now;
    }
  }
}

/// Lets all of x be where it was after the last load step, along the obstacles.
template <int B>
void stick_everywhere(const DiscreteProblem<B>& problem, std::vector<double>& x) {
  const Constraints<B>& c = problem.constraints;
  for (std::size_t slot = 0; slot < c.tangential.size(); ++slot)
    for (int k = 0; k < B; ++k)
      if ((c.tangential[slot] & ~problem.fixed[c.vector[slot]]) >> k & 1u)
        x[Offset{c.vector[slot]} * B + k] = c.last[slot * B + k];
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
