#pragma once
#include <vector>

#include "core/constraints/bound.hpp"
#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Asks functionals before a solve that starts at x, at up to a thousand nodes: their local solvers minimise, for the
/// forces there and for others as large, and what their changes and slopes say of steps is what a convex functional can
/// say. Faults of either make a wrong result, which else passes for solved.
/// @param acts per slot: the obstacle whose functional acts there, -1: none; empty without any
/// @param x local coordinates
/// @throws Error(Exit::plugin) that names the obstacle and the node
template <int B>
void probe_functionals(const ObstaclePlaces<B>& places, const DiscreteProblem<B>& problem,
                       const std::vector<Index>& acts, const std::vector<double>& x);

/// What only a fault of an obstacle with a functional explains in the result x of a solve: at its nodes x is not finite
/// or beyond the bounds, what its functional says there is not finite, or its local solver calls something else than
/// the minimiser one. Each node is asked once.
/// @param x local coordinates
/// @throws Error(Exit::plugin) that names the obstacle and the node
template <int B>
void check_functionals(const ObstaclePlaces<B>& places, const DiscreteProblem<B>& problem,
                       const std::vector<Index>& acts, const std::vector<double>& x);

/// The same after a solve that an error has ended at x, which need not be finite: nothing where functionals and local
/// solvers have finite answers to finite questions, and something else is the cause.
template <int B>
void blame_functionals(const ObstaclePlaces<B>& places, const DiscreteProblem<B>& problem,
                       const std::vector<Index>& acts, std::vector<double> x);

}  // namespace signorini
