#pragma once
#include <array>
#include <vector>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Krylov acceleration of cycles while the phases rest: the correction of a cycle is made A-orthogonal to the last
/// directions, and the energy minimised along it (truncated conjugate directions; Oosterlee and Washio, SIAM J. Sci.
/// Comput. 19, 1998). A d = r_before - r comes for free, so that it costs vector operations only. The cycle's own
/// result is kept wherever it has the lower energy or the accelerated one would leave the bounds.
template <int B>
class Recombination {
 public:
  explicit Recombination(const Constraints<B>& constraints) : constraints_(constraints) {}

  /// Forgets all directions: the phases have changed.
  void reset() { known_ = 0; }
  /// From the result x and its residual r of a cycle that started from x_before: the new direction. Returns whether
  /// the minimiser along it is within the bounds and should have a lower energy than x. Near rounding level that may
  /// not be so: the caller compares, and resets where it was not.
  bool propose(const std::vector<double>& x_before, const std::vector<double>& r_before, const std::vector<double>& x,
               const std::vector<double>& r);
  /// Writes that minimiser and its residual, at the vectors first <= p < last.
  void combine(const std::vector<double>& x_before, const std::vector<double>& r_before, Index first, Index last,
               std::vector<double>& x, std::vector<double>& r) const;

 private:
  static constexpr int depth = 2;
  struct Direction {
    std::vector<double> p, Ap;
    double energy = 0;  // p'Ap
  };

  bool admissible(const std::vector<double>& x_before) const;
  Direction& newest() { return directions_[next_]; }
  const Direction& newest() const { return directions_[next_]; }
  const Direction& older(int age) const { return directions_[(next_ + depth + 1 - age) % (depth + 1)]; }

  const Constraints<B>& constraints_;
  std::array<Direction, depth + 1> directions_;  // a ring
  int known_ = 0, next_ = 0;
  double step_ = 0;
};

}  // namespace signorini
