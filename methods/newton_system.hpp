#pragma once
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// The linear systems of Newton's method for forces f = A v - b: per vector the rows F A + V in v, with blocks F and V
/// of its own. An implementation may add unknowns and rows behind them.
template <int B>
class NewtonSystem {
 public:
  virtual ~NewtonSystem() = default;
  /// Its name in reports.
  virtual const char* name() const = 0;
  /// Unknowns: all of v first.
  virtual Offset size() const = 0;
  /// The rows of vector p, with F = by_force and V = by_value.
  virtual void set_row(Index p, const double* by_force, const double* by_value) = 0;
  /// Once all rows are set. Returns false where the matrix is singular.
  virtual bool factorise() = 0;
  /// Replaces the right-hand side by the solution. Returns false where none was found.
  virtual bool solve(std::vector<double>& b) = 0;
  /// What was done so far, see Stage.
  virtual int factorisations() const = 0;
  virtual int solves() const = 0;
};

}  // namespace signorini
