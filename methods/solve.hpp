#pragma once
#include <span>
#include <vector>

#include "core/component/registry.hpp"
#include "core/solver/discrete_problem.hpp"
#include "core/solver/options.hpp"
#include "core/solver/prolongation.hpp"
#include "core/solver/summary.hpp"

namespace signorini {

/// @throws Error(Exit::input) where an obstacle adds to the energy what the method of the options cannot treat
template <int B>
void check_method(const DiscreteProblem<B>& problem, const SolverOptions& options);

/// Solves the problem on the finest level by the method of the options.
/// @param prolongations coarsest first; the last one leads to the level of `problem`; none: a single level
/// @param x start and result, B per vector, local coordinates; it is made admissible first
/// @throws Error(Exit::input) for an option or component that does not exist, or a start that is not finite
template <int B>
Summary solve(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations, std::vector<double>& x,
              const SolverOptions& options, const Registry& registry, const Monitor& monitor = {});

}  // namespace signorini
