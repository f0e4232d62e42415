#pragma once
#include "amg/coarsening/aggregates.hpp"
#include "core/algebra/near_null_space.hpp"
#include "core/algebra/sparse_rows.hpp"
#include "core/component/registry.hpp"
#include "core/fem/assembly/discretize.hpp"
#include "core/solver/multigrid.hpp"
#include "methods/configuration.hpp"

namespace signorini::bench {

/// What conjugate gradients, preconditioned by one symmetric V(1,1) cycle of the project's own linear multigrid,
/// needed.
struct LinearSolve {
  double setup = 0, solve = 0;
  int iterations = 0;
  double residual = 0, algebraic_error = 0;
  double complexity = 0;  ///< of algebraic levels: entries of all their matrices over those of the finest
  std::vector<double> x;  ///< local coordinates
};

/// Solves a problem without obstacles from zero until the natural residual and the estimated relative algebraic error
/// are at most `tolerance`, as the nonlinear solver does.
template <int B>
LinearSolve multigrid_cg(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                         const Registry& registry, double tolerance);

/// The same on levels that a matrix gives, B rows to a vector.
template <int B>
LinearSolve algebraic_cg(const SparseRows& A, std::span<const double> b, double tolerance,
                         Coarsening coarsening = Coarsening::classical, const NearNullSpace& near_null = {},
                         const Aggregator& aggregator = GreedyAggregator());

}  // namespace signorini::bench
