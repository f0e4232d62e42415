#pragma once
#include <vector>

#include "core/fem/discretize.hpp"

namespace signorini {

/// What only a fault of an obstacle with a functional explains in the result x of a solve: at its nodes x is not finite
/// or beyond the bounds, or what its functional says there is not finite. Each node is asked once.
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
