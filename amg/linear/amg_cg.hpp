#pragma once
#include <memory>

#include "amg/linear/algebraic_cycle.hpp"
#include "core/algebra/linear_solver.hpp"

namespace signorini {

/// Conjugate gradients, preconditioned by a cycle on levels that the matrix without its scaling gives; for scalars.
class AmgConjugateGradients final : public LinearSolver {
 public:
  void analyse(const std::vector<Offset>& start, const std::vector<Index>& row) override;
  bool factorise(const std::vector<double>& value, const std::vector<double>& scale) override;
  bool solve(std::vector<double>& x) override;

 private:
  std::vector<Offset> start_;
  std::vector<Index> row_;
  std::vector<double> scale_;
  std::unique_ptr<AlgebraicCycle<1>> cycle_;
};

}  // namespace signorini
