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
  void reset() {
    known_ = 0;
    carried_ = 0;
  }
  /// A cycle begins.
  void begin() { along_ = {}; }
  /// Adds up what propose() needs of the step x - x_before at the vectors first <= p < last, while it is at hand.
  void add(const std::vector<double>& x_before, const std::vector<double>& x, Index first, Index last);
  /// From the result x and its residual r of a cycle that started from x_before and gained this much energy: the new
  /// direction. Returns whether the minimiser along it should have a lower energy than x. Near rounding level that may
  /// not be so: the caller compares. What is not taken has to be forgotten by reset().
  bool propose(const std::vector<double>& x_before, const std::vector<double>& r_before, const std::vector<double>& x,
               const std::vector<double>& r, double cycle_gain);
  /// After propose() with forces that are more than the residual b - A x, those of functionals: what of them is the
  /// residual of x_before and x, so that combine() knows it.
  void add_residuals(const std::vector<double>& r_before, const std::vector<double>& r);
  /// What rounding does to the residual of that minimiser, as a multiple of what it does to one that is computed from
  /// an iterate: differences of residuals are extrapolated, from one to the next. reset() ends that.
  double amplification() const { return carried_; }
  /// Writes that minimiser and its residual, from r_before, at the vectors first <= p < last. Returns whether it is
  /// within the bounds there.
  bool combine(const std::vector<double>& x_before, const std::vector<double>& r_before, Index first, Index last,
               std::vector<double>& x, std::vector<double>& r) const;

 private:
  static constexpr int depth = 2;
  struct Direction {
    std::vector<double> p, Ap;
    std::vector<double> of_residual;  // the part of Ap by the matrix alone; empty: all of it
    double beta1 = 0, beta2 = 0;      // of the two directions before, which were taken out
    double energy = 0;                // p'Ap
    double noise = 0;                 // of Ap, in units of what rounding does to a residual
  };

  bool admissible(const std::vector<double>& x, Index first, Index last) const;
  /// 0: the newest one
  const Direction& aged(int age) const { return directions_[(next_ + depth - age) % depth]; }

  const Constraints<B>& constraints_;
  std::array<Direction, depth> directions_;  // a ring: the newest one takes the place of the oldest
  int known_ = 0, next_ = 0;
  std::array<double, depth> along_{};  // (x - x_before)'Ap of the directions known before the cycle
  double step_ = 0;
  double carried_ = 0;  // noise of the residual that was combined last, in the same units
};

}  // namespace signorini
