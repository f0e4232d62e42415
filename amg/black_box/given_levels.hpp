#pragma once
#include <span>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/algebra/sparse_rows.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// The interpolations of another linear multigrid code, coarsest first, as levels of ours.
/// Error(Exit::input) naming the interpolation that does not fit to the next finer one, or the last one that does not
/// fit to the number of vectors, and entries that are not finite or in no column.
std::vector<Prolongation> given_levels(std::span<const SparseRows> interpolations, Index vectors);

/// Its coarse matrices, one for each of these levels, or none: where one has zero rows, all are to be computed.
/// Error(Exit::input) naming the matrix that is none of a level, by its size, symmetry or diagonal, or that is not the
/// Galerkin product P'AP of the next finer one: the products with one random vector are compared.
/// @param zero per vector of A the components whose rows are zero but for the diagonal that was put there
template <int B>
std::vector<BlockMatrix<B>> given_matrices(const BlockMatrix<B>& A, const std::vector<Flags>& zero,
                                           std::span<const Prolongation> levels, std::span<const SparseRows> matrices);

}  // namespace signorini
