#pragma once
#include <cmath>
#include <limits>

#include "core/solver/level.hpp"

namespace signorini {

/// What rounding may do to the work r'd of the residual r = b - A x at the vectors first <= p < last along directions d
/// with entries up to one. A row of A is taken for some multiple of its diagonal.
template <int B>
double rounding_of_work(const Level<B>& level, Index first, Index last) {
  double forces = 0;
  for (Index p = first; p < last; ++p)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{p} * B + k;
      if (!(level.off[p] >> k & 1u))
        forces += std::abs(level.b[i]) + 8 * level.A->diagonal(p)[k * B + k] * std::abs(level.x[i]);
    }
  return 16 * std::numeric_limits<double>::epsilon() * forces;
}

/// On the whole level, and what comes down with the residual from the finer ones. Interpolation has weights that sum to
/// one, so that entries of d stay up to one there.
template <int B>
double rounding_of_work(const Level<B>& level) {
  return level.inherited_rounding + rounding_of_work(level, 0, level.vectors);
}

}  // namespace signorini
