#pragma once
#include <cmath>
#include <limits>

#include "core/solver/level.hpp"

namespace signorini {

/// What rounding may do to the work d'Ax along directions d with entries up to one at the vectors first <= p < last. A
/// row of A is taken for some multiple of its diagonal.
/// @param off per vector: components that do no work
template <int B>
double rounding_of_work(const BlockMatrix<B>& A, const std::vector<Flags>& off, const double* x, Index first,
                        Index last) {
  double forces = 0;
  for (Index p = first; p < last; ++p)
    for (int k = 0; k < B; ++k)
      if (!(off[p] >> k & 1u)) forces += A.diagonal(p)[k * B + k] * std::abs(x[Offset{p} * B + k]);
  return 128 * std::numeric_limits<double>::epsilon() * forces;
}

/// The same for the residual b - A x of a level.
template <int B>
double rounding_of_work(const Level<B>& level, Index first, Index last) {
  double loads = 0;
  for (Index p = first; p < last; ++p)
    for (int k = 0; k < B; ++k)
      if (!(level.off[p] >> k & 1u)) loads += std::abs(level.b[Offset{p} * B + k]);
  return 16 * std::numeric_limits<double>::epsilon() * loads +
         rounding_of_work(*level.A, level.off, level.x, first, last);
}

/// On the whole level, and what comes down with the residual from the finer ones. Interpolation has weights that sum to
/// one, so that entries of d stay up to one there.
template <int B>
double rounding_of_work(const Level<B>& level) {
  return level.inherited_rounding + rounding_of_work(level, 0, level.vectors);
}

}  // namespace signorini
