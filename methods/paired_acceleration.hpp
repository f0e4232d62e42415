#pragma once
#include <array>
#include <vector>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Acceleration of cycles with a load that follows the solution (core/solver/following_load.hpp), while the phases
/// rest: among the combinations of the last steps the one whose next step is the shortest, were the iteration linear
/// (Anderson, J. ACM 12, 1965; Walker and Ni, SIAM J. Numer. Anal. 49, 2011). The length is measured by A for the
/// displacements and by S for what the load depends on. A times a step of the displacements is the difference of
/// residuals, so that no product is needed. Thin bodies that are held along their length have many slow pressures, and
/// so the memory is long: two vectors for each step, as far as there are steps.
template <int B>
class PairedAcceleration {
 public:
  /// @param tolerance of positions, over the largest displacement
  PairedAcceleration(const Constraints<B>& constraints, double tolerance)
      : constraints_(constraints), tolerance_(tolerance) {}

  /// Forgets all steps: the phases have changed.
  void reset() {
    steps_ = known_ = next_ = 0;
    last_way_ = 0;
  }
  /// A step has led from x_before to x, with residuals of one load, and to a change of p, S times which is given.
  void add_step(const std::vector<double>& x_before, const std::vector<double>& x, const std::vector<double>& r_before,
                const std::vector<double>& r, const std::vector<double>& change, const std::vector<double>& S_change);
  /// Combines what that step leads to with what the ones before led to.
  /// @param x, p where the step leads to; become the combination, next to it within the bounds, where there is one
  /// @return whether there is
  bool combine(std::vector<double>& x, std::vector<double>& p);

 private:
  static constexpr int depth = 60;
  /// Of x and p.
  struct Pair {
    std::vector<double> x, p;
  };
  /// A step with its image under A and S, and where it led to.
  struct Step {
    Pair step, image, result;
    double squared = 0;
  };
  /// The difference of two steps, orthogonal to the others, and that of where they led to.
  struct Direction {
    Pair step, result;
    double squared = 0;
  };

  /// That to the step before.
  void find_difference(Direction& out);
  void make_orthogonal(Direction& newest);
  void project(std::vector<double>& x) const;

  const Constraints<B>& constraints_;
  const double tolerance_;
  Step now_, before_;
  std::array<Direction, depth> directions_;  // a ring
  int steps_ = 0, known_ = 0, next_ = 0;
  Pair image_;  // of the newest difference
  Pair way_;    // from where the step leads to to the combination
  double last_way_ = 0;
};

}  // namespace signorini
