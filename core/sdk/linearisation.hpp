#pragma once
#include "core/sdk/level_view.hpp"

namespace signorini {

/// What a functional looks like near the iterate, where it is smooth. All arrays are per slot of the level.
template <int B>
struct QuadraticModel {
  double* gradient;  ///< B: of the smooth piece of phi at the iterate; zero in components that are not smooth
  double* hessian;   ///< B * B, row-major, symmetric, semidefinite; zero in rows of components that are not smooth
  /// B: corrections of the iterate. On entry what the bounds admit; zero in components that are not smooth. How far the
  /// smooth piece is a good model is for the line search to find out: narrower bounds slow down more than they help.
  double *lower, *upper;
  Flags* critical;  ///< on entry what the bounds hold; components in which phi is not smooth are added
};

/// Of a functional: the model of it that coarse corrections minimise.
template <int B>
class Linearisation {
 public:
  virtual ~Linearisation();

  /// Gradient and Hessian of the smooth piece at level.x, where they hold, and the components that are not smooth, at
  /// the vectors first <= p < last of one segment.
  virtual void linearise(const LevelView<B>& level, Index first, Index last,
                         const QuadraticModel<B>& out) const noexcept = 0;
};

}  // namespace signorini
