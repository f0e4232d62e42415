#pragma once
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/algebra/sparse_rows.hpp"

namespace signorini {

/// A symmetric matrix of scalars in blocks. Zero blocks are left out, so that the pattern is symmetric, too.
///
/// Error(Exit::input) where the matrix is not square, does not divide into blocks of size B, is not symmetric but for
/// rounding, or is seen not to be positive semidefinite: by its diagonal, which must be positive, or by two rows and
/// columns alone. Messages count rows and columns from 1.
/// @param zero_rows rows without any entry are allowed: they become those of the identity, and the bits of their
///     components are set here, in one value per vector; null: they are refused
template <int B>
BlockMatrix<B> block_matrix(const SparseRows& matrix, std::vector<Flags>* zero_rows = nullptr);

}  // namespace signorini
