#pragma once
#include <span>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

struct Interval {
  double lower, upper;

  bool empty() const { return lower > upper || lower == infinity || upper == -infinity; }
  bool all() const { return lower == -infinity && upper == infinity; }
};

/// The bounds of n unknowns; empty spans: none.
class GivenBounds {
 public:
  /// Error(Exit::input) for sizes that do not fit and for NaN, Error(Exit::no_solution) where no number lies between
  /// the bounds of a row, counted from 1.
  GivenBounds(std::size_t n, std::span<const double> lower, std::span<const double> upper);

  Interval operator[](std::size_t i) const {
    return {lower_.empty() ? -infinity : lower_[i], upper_.empty() ? infinity : upper_[i]};
  }

 private:
  std::span<const double> lower_, upper_;
};

/// The bounds of the unknowns in blocks of size B that are not held.
/// @param held per block
template <int B>
Constraints<B> constraints(const GivenBounds& bounds, const std::vector<Flags>& held);

}  // namespace signorini
