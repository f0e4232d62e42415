#pragma once
#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Writes to Q (B * B, row-major) an orthogonal matrix whose first columns are the `leading` and whose last ones are
/// the `trailing` orthonormal vectors, B entries each; Householder reflections supply the columns between them. The
/// identity when the given vectors are the coordinate axes in their places.
template <int B>
void local_basis(const double* leading, int leading_count, const double* trailing, int trailing_count, double* Q);

/// A_pq <- Q_p' A_pq Q_q and b_p <- Q_p' b_p.
template <int B>
void rotate(BlockMatrix<B>& A, std::vector<double>& b, const Frames<B>& frames);

/// Makes the rows and columns of fixed components those of the identity, symmetrically, and b that of the problem for
/// the others, with the prescribed values in the fixed ones. Returns 1/2 v'Av - b'v of the prescribed values v, the
/// part of the energy that is lost with them.
/// @param value B per vector, zero in components that are not fixed
template <int B>
double eliminate(BlockMatrix<B>& A, std::vector<double>& b, const std::vector<Flags>& fixed,
                 const std::vector<double>& value);

}  // namespace signorini
