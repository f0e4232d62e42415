#pragma once
#include <span>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// A_pq <- Q_p' A_pq Q_q.
template <int B>
void rotate(BlockMatrix<B>& A, const Frames<B>& frames);
/// b_p <- Q_p' b_p.
template <int B>
void rotate(std::vector<double>& b, const Frames<B>& frames);

/// Unknowns in global coordinates, and back; B per vector.
template <int B>
void out_of_frames(const Frames<B>& frames, std::vector<double>& x);
template <int B>
void into_frames(const Frames<B>& frames, std::vector<double>& x);

/// Forces on displacements in global coordinates as those on the problem's unknowns.
template <int B>
std::vector<double> local_forces(const DiscreteProblem<B>& problem, std::vector<double> forces);

/// Makes the rows and columns of fixed components those of the identity, symmetrically, and b that of the problem for
/// the others, with the prescribed values of `start` in the fixed ones. Fills in what the energy loses by it:
/// prescribed_energy, prescribed_work, coupled and coupling.
template <int B>
void eliminate(DiscreteProblem<B>& problem);

/// The part of eliminate() that is no matrix: vector p has prescribed components or is coupled to such ones, by A v,
/// its row times the prescribed values. For ascending p.
template <int B>
void prescribe(DiscreteProblem<B>& problem, Index p, const double* Av);

/// The same where only these vectors, in ascending order, have fixed components or are coupled to such ones.
template <int B>
void eliminate(DiscreteProblem<B>& problem, std::span<const Index> vectors);

}  // namespace signorini
