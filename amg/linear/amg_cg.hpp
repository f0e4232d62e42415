#pragma once
#include <functional>
#include <memory>
#include <utility>

#include "amg/linear/algebraic_cycle.hpp"
#include "core/algebra/linear_solver.hpp"

namespace signorini {

/// Conjugate gradients, preconditioned by a cycle on levels that the matrix without its scaling gives; for scalars.
class AmgConjugateGradients final : public LinearSolver {
 public:
  /// @param components gives what its cycle is composed from, see AlgebraicCycle
  explicit AmgConjugateGradients(std::function<Registry()> components) : components_(std::move(components)) {}

  void analyse(const std::vector<Offset>& start, const std::vector<Index>& row) override;
  bool factorise(const std::vector<double>& value, const std::vector<double>& scale) override;
  bool solve(std::vector<double>& x) override;

 private:
  std::function<Registry()> components_;
  std::vector<Offset> start_;
  std::vector<Index> row_;
  std::vector<double> scale_;
  std::unique_ptr<AlgebraicCycle<1>> cycle_;
};

}  // namespace signorini
