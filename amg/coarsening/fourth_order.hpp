#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/solver/discrete_problem.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// The operator of second order whose square a matrix about is, such as the Laplacian of a plate or beam, found in the
/// matrix alone: A = c L'L with L = diag(d) - W gives a_ij = -(d_i + d_j) w_ij where a_ij < 0, and a_ii = d_i^2 + the
/// sum of the w_ij^2. L is symmetric with W >= 0 and weakly dominant diagonal, which dominates where A has more than
/// such a row says: next to prescribed values. Nothing where the square of L is not about A, or L far from singular.
/// @param off vectors whose components are prescribed; their rows are those of the identity
std::optional<BlockMatrix<1>> second_order_root(const BlockMatrix<1>& A, const std::vector<Flags>& off);

/// About the solution v of L v = 1, by one sweep up through the levels of L: a smooth function that falls off towards
/// prescribed values as all solutions do.
/// @param prolongations, matrices of the coarser levels, coarsest first
std::vector<double> under_even_load(const BlockMatrix<1>& L, const std::vector<Flags>& off,
                                    std::span<const Prolongation> prolongations,
                                    std::span<const GalerkinMatrix<1>> matrices);

/// What coarse vectors have of v: its values at their twins.
std::vector<double> at_twins(const std::vector<double>& v, const Prolongation& P);

/// Scales the weights of vectors near prescribed values, whose sum is less than one, such that v is interpolated
/// exactly: by classical weights a plate that is simply supported would get a kink next to its edge.
void fit_near_edges(const std::vector<double>& v, Prolongation& P);

/// Damping at which a Jacobi step leaves no kinks of an interpolated v: 1/2 on a line, about 1 for the five-point
/// stencil. In sixteenths, so that products of weights on a line are exact; at most 1.
double kink_damping(const BlockMatrix<1>& L, const std::vector<Flags>& off, const Prolongation& P,
                    const std::vector<double>& v);

/// Interpolations of second order have kinks, which cost an operator of fourth order far too much energy: here they are
/// rounded off by a damped Jacobi step with the operator of second order. On a line, linear interpolation becomes that
/// of cubic B-splines. Weights stay positive, and linear functions are reproduced where they were.
/// @param L on the fine level
Prolongation rounded_off(const BlockMatrix<1>& L, const std::vector<Flags>& off, const Prolongation& P, double damping);

}  // namespace signorini
