#pragma once
#include "amg/coarsening/hierarchy.hpp"
#include "core/algebra/energy_along.hpp"

namespace signorini {

/// What a factorisation may take without being seen beside a set-up, for a lower triangle with so many entries.
double affordable_operations(Offset entries);

/// Error(Exit::input) where a direction d with d'Ad < 0 is found, naming the row of its largest entry: by the smooth
/// directions of least energy, from the coarsest level upwards, and by a few conjugate gradient steps on every level,
/// which see the rough ones. This is a search, no proof.
/// @param A with a positive diagonal
template <int B>
void refuse_indefinite(const BlockMatrix<B>& A, const AlgebraicLevels<B>& levels);

/// The same by up to 2000 conjugate gradient steps on the whole matrix alone, for a random right-hand side. Where they
/// converge there is no such direction, but by chance; where they do not, smaller negative eigenvalues may be missed.
template <int B>
void refuse_indefinite_by_steps(const BlockMatrix<B>& A);

}  // namespace signorini
