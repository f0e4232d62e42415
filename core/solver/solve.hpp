#pragma once
#include <functional>
#include <span>
#include <vector>

#include "core/component/registry.hpp"
#include "core/solver/discrete_problem.hpp"
#include "core/solver/options.hpp"
#include "core/solver/prolongation.hpp"
#include "core/solver/summary.hpp"

namespace signorini {

/// Called after every cycle; returning false interrupts the solve, which then ends with Outcome::interrupted.
using Monitor = std::function<bool(const IterationRecord&)>;

/// Truncated monotone multigrid for the problem on the finest level.
/// @param prolongations coarsest first; the last one leads to the level of `problem`; none: a single level
/// @param x start and result, B per vector, local coordinates; it is made admissible first
/// @throws Error(Exit::input) for an option or component that does not exist, or a start that is not finite
template <int B>
Summary solve(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations, std::vector<double>& x,
              const SolverOptions& options, const Registry& registry, const Monitor& monitor = {});

}  // namespace signorini
