#pragma once
#include <vector>

#include "core/fem/assembly/discretize.hpp"

namespace signorini {

/// Asks functionals before a solve that starts at x, at up to a thousand nodes: their local solvers minimise, for the
/// forces there and for others as large, and what their changes and slopes say of steps is what a convex functional can
/// say. Faults of either make a wrong result, which else passes for solved.
/// @param x local coordinates
/// @throws Error(Exit::plugin) that names the obstacle and the node
template <int D, int B>
void probe_functionals(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
                       const std::vector<double>& x);

/// What only a fault of an obstacle with a functional explains in the result x of a solve: at its nodes x is not finite
/// or beyond the bounds, what its functional says there is not finite, or its local solver calls something else than
/// the minimiser one. Each node is asked once.
/// @param x local coordinates
/// @throws Error(Exit::plugin) that names the obstacle and the node
template <int D, int B>
void check_functionals(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
                       const std::vector<double>& x);

/// The same after a solve that an error has ended at x, which need not be finite: nothing where functionals and local
/// solvers have finite answers to finite questions, and something else is the cause.
template <int D, int B>
void blame_functionals(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
                       std::vector<double> x);

}  // namespace signorini
