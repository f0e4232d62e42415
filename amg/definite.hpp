#pragma once
#include "amg/hierarchy.hpp"

namespace signorini {

/// Error(Exit::input) where a direction d with d'Ad < 0 is found, naming the row of its largest entry: by a few
/// conjugate gradient steps on every level, so that rough directions show as well as smooth ones. Where the diagonal
/// dominates there is none; else this is a search, no proof.
/// @param A with a positive diagonal
template <int B>
void refuse_indefinite(const BlockMatrix<B>& A, const AlgebraicLevels<B>& levels);

/// Whether each diagonal entry is at least the sum of the moduli of the others in its row, but for rounding.
template <int B>
bool diagonal_dominates(const BlockMatrix<B>& A);

}  // namespace signorini
