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
  Recombination(const Constraints<B>& constraints, std::size_t unknowns);

  /// Forgets all directions: the phases have changed.
  void reset() { known_ = 0; }
  /// From the result x and its residual r of a cycle that started from x_before: writes to `trial` the minimiser along
  /// the new direction. Returns whether there is one that should lower the energy further, within the bounds. Near
  /// rounding level that may not be so: the caller compares, and resets where it was not.
  bool propose(const std::vector<double>& x_before, const std::vector<double>& r_before, const std::vector<double>& x,
               const std::vector<double>& r, std::vector<double>& trial);

 private:
  static constexpr int depth = 2;
  struct Direction {
    std::vector<double> p, Ap;
    double energy = 0;  // p'Ap
  };

  bool admissible(const std::vector<double>& x_before, const Direction& direction, double step) const;

  const Constraints<B>& constraints_;
  std::array<Direction, depth + 1> directions_;  // a ring; the newest is at next_ - 1
  int known_ = 0, next_ = 0;
};

}  // namespace signorini
