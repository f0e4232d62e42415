#pragma once
#include <memory>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/algebra/linear_solver.hpp"

namespace signorini {

/// Linear systems with a block matrix A some of whose unknowns are held and whose diagonal is increased, solved by a
/// linear solver that knows the pattern once for all of them.
template <int B>
class SparseSystem {
 public:
  /// Keeps a reference to A.
  SparseSystem(const BlockMatrix<B>& A, std::unique_ptr<LinearSolver> linear);

  /// Of A.
  double diagonal(Offset i) const;

  /// @param held per unknown: 0 or decoupled from all others
  /// @param added per unknown: >= 0, to the diagonal
  /// @return whether the matrix is positive definite, as far as that is seen here
  bool factorise(const std::vector<char>& held, const std::vector<double>& added);
  /// Replaces the right-hand side by the solution. Returns whether that was possible.
  bool solve(std::vector<double>& b);

  int factorisations() const { return factorisations_; }
  int solves() const { return solves_; }

 private:
  template <class Visit>
  void visit_lower_triangle(const Visit& visit) const;

  const BlockMatrix<B>& A_;
  std::unique_ptr<LinearSolver> linear_;
  std::vector<double> value_, scale_;
  int factorisations_ = 0, solves_ = 0;
};

}  // namespace signorini
