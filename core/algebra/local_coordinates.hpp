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
/// the others, with the prescribed values of `start` in the fixed ones. Fills in what the energy loses by it:
/// prescribed_energy, prescribed_work, coupled and coupling.
template <int B>
void eliminate(DiscreteProblem<B>& problem);

}  // namespace signorini
