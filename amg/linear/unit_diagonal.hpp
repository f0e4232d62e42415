#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "core/algebra/block_matrix.hpp"

namespace signorini {

/// The lower triangle of a matrix in units in which its diagonal is one: s_i a_ij s_j with s_i = 1 / sqrt(a_ii), B rows
/// per vector. Masked components keep their diagonal entry alone.
/// @param mask per vector
/// @param scale s, zero on masked components
template <int B>
Eigen::SparseMatrix<double> with_unit_diagonal(const BlockMatrix<B>& A, const std::vector<Flags>& mask,
                                               std::vector<double>& scale);

/// The same without any rounding: s_i are the powers of two next to that, and the diagonal lies between 1/2 and 2.
template <int B>
Eigen::SparseMatrix<double> scaled_exactly(const BlockMatrix<B>& A, const std::vector<Flags>& mask,
                                           std::vector<double>& scale);

}  // namespace signorini
