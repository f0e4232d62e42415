#pragma once
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// Solves with sparse square matrices of any kind; an implementation is a component of kind "unsymmetric".
class UnsymmetricSolver {
 public:
  virtual ~UnsymmetricSolver() = default;
  /// Takes a pattern in compressed rows: `start` has one entry more than there are rows, columns ascend in each row.
  virtual void analyse(const std::vector<Offset>& start, const std::vector<Index>& column) = 0;
  /// Takes the values before any solve(). Returns false where the matrix is singular.
  virtual bool factorise(const std::vector<double>& value) = 0;
  /// x = A^-1 x
  virtual void solve(std::vector<double>& x) = 0;
};

}  // namespace signorini
