#pragma once
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// Solves with sparse symmetric positive definite matrices; an implementation is a component of kind "linear".
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Takes a symmetric pattern, given as the lower triangle in compressed columns: `start` has one entry more than
  /// there are columns, row indices ascend in each column.
  virtual void analyse(const std::vector<Offset>& start, const std::vector<Index>& row) = 0;
  /// Takes the values of a matrix SAS whose diagonal is one, with S = diag(scale), before any solve(). Returns whether
  /// it is positive definite by more than rounding, as far as that is seen here.
  virtual bool factorise(const std::vector<double>& value, const std::vector<double>& scale) = 0;
  /// x = (SAS)^-1 x. Returns whether that was possible.
  virtual bool solve(std::vector<double>& x) = 0;
};

}  // namespace signorini
