#pragma once
#include <cmath>
#include <limits>

#include "core/solver/level.hpp"

namespace signorini {

/// What rounding may do to the work r'd of the residual r = b - A x along directions d with entries up to one: what it
/// does on this level, and on the finer ones, from where it comes down with the residual. Interpolation has weights
/// that sum to one, so that entries of d stay up to one there. A row of A is taken for some multiple of its diagonal.
template <int B>
double rounding_of_work(const Level<B>& level) {
  double forces = 0;
  for (Index p = 0; p < level.vectors; ++p)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{p} * B + k;
      if (!(level.off[p] >> k & 1u))
        forces += std::abs(level.b[i]) + 8 * level.A->diagonal(p)[k * B + k] * std::abs(level.x[i]);
    }
  return level.inherited_rounding + 16 * std::numeric_limits<double>::epsilon() * forces;
}

}  // namespace signorini
