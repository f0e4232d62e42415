#pragma once
#include <vector>

#include "core/solver/discrete_problem.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// A solution of one level as a start for the next finer one, both in the local coordinates of their problems.
/// Components that are prescribed on the fine level take their prescribed values.
template <int B>
std::vector<double> interpolate(const DiscreteProblem<B>& coarse, const std::vector<double>& x,
                                const Prolongation& prolongation, const DiscreteProblem<B>& fine);

/// Whether the matrix of the coarse problem is the Galerkin product P'AP of the fine one, as for nested elements with
/// the same coefficients, in the frames that a solver gives its coarser levels: compares the energies of one random
/// vector on both levels.
template <int B>
bool is_galerkin(const DiscreteProblem<B>& coarse, const Prolongation& prolongation, const DiscreteProblem<B>& fine);

}  // namespace signorini
