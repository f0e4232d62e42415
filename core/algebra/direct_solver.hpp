#pragma once
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// Cholesky factorisation of sparse matrices; an implementation is a component of kind "direct".
class DirectSolver {
 public:
  virtual ~DirectSolver() = default;
  /// Orders the unknowns for a symmetric pattern, given as the lower triangle in compressed columns: `start` has one
  /// entry more than there are columns, row indices ascend in each column.
  virtual void analyse(const std::vector<Offset>& start, const std::vector<Index>& row) = 0;
  /// Factorises the matrix with these values, whose diagonal is one. Returns whether it is positive definite by more
  /// than rounding.
  virtual bool factorise(const std::vector<double>& value) = 0;
  /// x = A^-1 x with the matrix factorised last.
  virtual void solve(std::vector<double>& x) = 0;
};

}  // namespace signorini
