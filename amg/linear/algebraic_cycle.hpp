#pragma once
#include "amg/coarsening/hierarchy.hpp"
#include "core/component/registry.hpp"
#include "core/solver/multigrid.hpp"

namespace signorini {

/// One symmetric V cycle on levels that a positive definite matrix gives, as a preconditioner.
template <int B>
class AlgebraicCycle {
 public:
  /// @param components what the cycle is composed from: smoothers, transfers, coarse solvers
  /// @param sweeps before and after each correction
  AlgebraicCycle(Registry components, BlockMatrix<B> A, int sweeps);
  AlgebraicCycle(const AlgebraicCycle&) = delete;
  AlgebraicCycle& operator=(const AlgebraicCycle&) = delete;

  const BlockMatrix<B>& matrix() const { return problem_.A; }
  /// z = M^-1 r, B per vector
  void apply(const double* r, double* z);

 private:
  const Registry registry_;
  DiscreteProblem<B> problem_;
  AlgebraicLevels<B> levels_;
  std::unique_ptr<MonotoneMultigrid<B>> multigrid_;
};

/// What such a cycle is composed from.
template <int B>
Components<B> symmetric_cycle(const Registry& registry);

}  // namespace signorini
