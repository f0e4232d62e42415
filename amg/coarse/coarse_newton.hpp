#pragma once
#include "amg/linear/held_cholesky.hpp"
#include "core/solver/components.hpp"
#include "core/solver/falling.hpp"
#include "core/solver/masked_cg.hpp"

namespace signorini {

/// Coarsest level: projected Gauss-Seidel sweeps settle the phases, a Newton step on the free components does the rest,
/// unless a few sweeps more promise to be enough where that would need a factorisation.
/// The step is solved by conjugate gradients with a Cholesky factorisation that is renewed only when it has become a
/// bad preconditioner (one iteration while it is fresh), or with symmetric Gauss-Seidel where the level is too large to
/// factorise. Semidefinite matrices are allowed. The energy never grows.
template <int B>
class CoarseNewton final : public CoarseSolver<B>, public Falling {
 public:
  bool solve(const Level<B>& level) override;
  void go_on(bool wanted) override { goes_on_ = wanted; }
  const Eigen::MatrixXd& left_out() const override { return left_out_; }

 private:
  bool newton_step(const Level<B>& level);
  CgResult solve_directly(const Level<B>& level);
  bool holds_everything() const;
  CgResult solve_iteratively(const Level<B>& level);
  bool factorise(const Level<B>& level, const std::vector<Flags>& mask);
  Eigen::MatrixXd motions() const;
  bool falls_forever(const Level<B>& level) const;
  bool move_across(const Level<B>& level);
  void precondition(const Level<B>& level, const std::vector<double>& r, std::vector<double>& z) const;
  bool move(const Level<B>& level, bool singular);

  std::vector<Flags> mask_;
  std::vector<double> r_, rest_, d_, scale_;  // scale_: 1 / sqrt(diagonal), which makes the factorisation free of units
  HeldCholesky factor_;
  bool worn_ = true;
  bool too_dear_ = false;  // to be factorised
  bool goes_on_ = false;
  Eigen::MatrixXd left_out_;
};

/// Coarsest level by projected symmetric Gauss-Seidel alone.
template <int B>
class CoarseGaussSeidel final : public CoarseSolver<B> {
 public:
  bool solve(const Level<B>& level) override;
};

}  // namespace signorini
