#pragma once
#include "apps/bench/peers/linear_solver.hpp"

namespace signorini::bench {

/// Primal-dual active sets [Hintermueller, Ito, Kunisch, SIAM J. Optim. 13 (2003)], each linear system solved only as
/// far as pays off while the set still changes.
struct ActiveSetOptions {
  double reduction = 1e-2;  ///< of the residual per linear solve while the set changes
  int lag = 100;            ///< steps that a preconditioner serves
  bool nested = true;       ///< start from the solution on the next coarser level, else from P(0)
};

/// The interpolated solution of the next coarser level.
std::vector<double> start_from(const GridLevel& level, const std::vector<double>& coarse);

/// To a natural residual of `tolerance`; iterations are those on the finest level. Throws where 300 steps do not do.
Attempt active_set(const Instance& instance, const MakeLinearSolver& make, const ActiveSetOptions& options,
                   double tolerance);

}  // namespace signorini::bench
