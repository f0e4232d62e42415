#pragma once
#include <span>

#include "core/algebra/block_matrix.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Error(Exit::input) where a direction d with d'Ad < 0 is found, naming the row of its largest entry: by a few
/// conjugate gradient steps with a correction on every level, so that rough directions show as well as smooth ones.
/// A search, no proof that there is none.
/// @param A with a positive diagonal
/// @param prolongations coarsest first
template <int B>
void refuse_indefinite(const BlockMatrix<B>& A, std::span<const Prolongation> prolongations);

}  // namespace signorini
