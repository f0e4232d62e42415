#pragma once
#include <memory>

#include "apps/bench/peers/instance.hpp"

namespace signorini::bench {

/// Solves the linear systems of an active set method.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Entries may become zero but keep their place, so that a symbolic factorisation serves all matrices of a size.
  virtual bool wants_fixed_pattern() const { return false; }

  /// @param A symmetric positive definite; stays until the next call
  /// @param coordinates three per vector
  virtual void set_up(const SparseRows& A, const std::vector<double>& coordinates) = 0;
  /// Another matrix of the size, close to the last one: what was set up for that may serve as preconditioner.
  virtual void change(const SparseRows& A) = 0;
  /// Improves x until the 2-norm of the residual has dropped by `reduction`; returns iterations.
  virtual int solve(const std::vector<double>& b, std::vector<double>& x, double reduction) = 0;
};

using MakeLinearSolver = std::function<std::unique_ptr<LinearSolver>()>;

/// Supernodal Cholesky factorisation by CHOLMOD, ordered by METIS.
std::unique_ptr<LinearSolver> cholmod_solver();

/// Conjugate gradients preconditioned by AMGCL's smoothed aggregation. Only where AMGCL was found.
std::unique_ptr<LinearSolver> amgcl_solver(int block);

}  // namespace signorini::bench
