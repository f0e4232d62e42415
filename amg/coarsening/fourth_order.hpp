#pragma once
#include <optional>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// The operator of second order whose square a matrix about is, such as the Laplacian of a plate or beam, found in the
/// matrix alone: A = c L'L with L = diag(d) - W gives a_ij = -(d_i + d_j) w_ij where a_ij < 0, and a_ii = d_i^2 + the
/// sum of the w_ij^2. L is symmetric with W >= 0 and weakly dominant diagonal, which dominates where A has more than
/// such a row says: next to prescribed values. Nothing where the square of L is not about A, or L far from singular.
/// @param off vectors whose components are prescribed; their rows are those of the identity
std::optional<BlockMatrix<1>> second_order_root(const BlockMatrix<1>& A, const std::vector<Flags>& off);

/// Interpolations of second order have kinks, which cost an operator of fourth order far too much energy: here they are
/// rounded off by a damped Jacobi step with the operator of second order. On a line, linear interpolation becomes about
/// that of cubic B-splines. Weights stay positive, and linear functions are reproduced where they were.
/// @param L on the fine level
Prolongation rounded_off(const BlockMatrix<1>& L, const std::vector<Flags>& off, const Prolongation& P);

}  // namespace signorini
