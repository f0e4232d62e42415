#pragma once
#include <span>
#include <vector>

#include "core/solver/discrete_problem.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// About the squared energy norm of what x is away from the solution: the forces that no bound holds, squared, over the
/// stiffness, on all levels (Bramble, Pasciak and Xu, Math. Comput. 55, 1990). Forces on the finest level alone know
/// next to nothing of smooth errors. Functionals and facets count as if they held nothing.
/// @param prolongations, matrices of the coarser levels, coarsest first
/// @param x admissible
template <int B>
double squared_distance(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                        std::span<const GalerkinMatrix<B>> matrices, const std::vector<double>& x);

/// Whether coarser levels have nothing to add to a start: whether it is nearer to the solution than zero is by what
/// nested iteration gains, as far as squared_distance() tells. It is made admissible and smoothed for that.
template <int B>
bool is_near(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
             std::span<const GalerkinMatrix<B>> matrices, std::vector<double>& x);

}  // namespace signorini
