#pragma once
#include <cmath>
#include <limits>

#include "core/solver/level.hpp"

namespace signorini {

/// What rounding may do to the work along directions with entries up to one of the forces at the vectors first <= p <
/// last.
/// @param off per vector: components that do no work
/// @param terms terms(p, k): the sizes of what the force is a sum of, together
template <int B, class Terms>
double rounding_of_work(const std::vector<Flags>& off, Index first, Index last, const Terms& terms) {
  double sum = 0;
  for (Index p = first; p < last; ++p)
    for (int k = 0; k < B; ++k)
      if (!(off[p] >> k & 1u)) sum += terms(p, k);
  return 16 * std::numeric_limits<double>::epsilon() * sum;
}

/// The terms of Ax: a row of A is taken for some multiple of its diagonal.
template <int B>
double terms_of_product(const BlockMatrix<B>& A, const double* x, Index p, int k) {
  return 8 * A.diagonal(p)[k * B + k] * std::abs(x[Offset{p} * B + k]);
}

/// For the residual b - A x of a level.
template <int B>
double rounding_of_work(const Level<B>& level, Index first, Index last) {
  return rounding_of_work<B>(level.off, first, last, [&](Index p, int k) {
    return std::abs(level.b[Offset{p} * B + k]) + terms_of_product(*level.A, level.x, p, k);
  });
}

/// On the whole level, and what comes down with the residual from the finer ones. Interpolation has weights that sum to
/// one, so that entries of d stay up to one there.
template <int B>
double rounding_of_work(const Level<B>& level) {
  return level.inherited_rounding + rounding_of_work(level, 0, level.vectors);
}

}  // namespace signorini
