#pragma once
#include <span>

#include "core/component/registry.hpp"
#include "core/solver/discrete_problem.hpp"
#include "methods/solve.hpp"

namespace signorini {

/// A start by nested iteration on the levels that prolongations make of a problem, when no mesh gives any: each coarser
/// level has the Galerkin matrix and right-hand side, and the bounds of the fine twins of its vectors, as if the
/// obstacle were assembled on it. A level that cannot be solved gives no start, nor does one whose solution has here,
/// made admissible, and smoothed, more energy than none.
/// @param problem its `galerkin`, where it is not empty, saves the products of matrices
/// @param prolongations coarsest first; the last one leads to the level of `problem`
/// @param options of the solve that is to come; the levels are solved less accurately
/// @param dropped gets a stage for each level that gave no start, with the reason
/// @return B per vector, not yet admissible between the twins; prescribed values are in place
/// @throws Error(Exit::interrupted) only, where the monitor does
template <int B>
std::vector<double> nested_start(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                                 const SolverOptions& options, const Registry& registry, const Monitor& monitor = {},
                                 std::vector<Stage>* dropped = nullptr);

/// The same from a start that is given: nested iteration for the correction to it, so that what coarser levels get
/// wrong is that of the correction only. Where they represent the correction no better than the solution, nested
/// iteration without the given start as well, and of the two what has less energy.
/// @param problem without frames; is changed meanwhile, and put back
/// @param given B per vector, need not be admissible
template <int B>
std::vector<double> nested_start_from(const std::vector<double>& given, DiscreteProblem<B>& problem,
                                      std::span<const Prolongation> prolongations, const SolverOptions& options,
                                      const Registry& registry, const Monitor& monitor = {},
                                      std::vector<Stage>* dropped = nullptr);

}  // namespace signorini
