#pragma once
#include "core/sdk/level_view.hpp"

namespace signorini {

/// Where a nonlinearity writes what it looks like near the iterate. All arrays are per slot of the level.
template <int B>
struct Linearisation {
  double* gradient;  ///< B: of the smooth piece of phi at the iterate; zero in components that are not smooth
  double* hessian;   ///< B * B, row-major, symmetric, semidefinite; zero in rows of components that are not smooth
  /// B: corrections of the iterate. On entry what the bounds admit; zero in components that are not smooth. How far the
  /// smooth piece is a good model is for the line search to find out: narrower bounds slow down more than they help.
  double *lower, *upper;
  Flags* critical;  ///< on entry what the bounds hold; components in which phi is not smooth are added
};

/// Friction at a slot: its tangential force is at most bound + coefficient * (the force that presses).
struct FrictionLaw {
  double coefficient, bound;
};

/// What an obstacle adds to the energy beside its bounds: the sum of phi_p(x_p) over its slots, each phi_p convex and
/// piecewise smooth while LevelView::data rest (Krause, 2.3; Graeser and Kornhuber 2009). An optional extension of
/// Obstacle: see Obstacle::nonlinearity(). Plugins derive from FunctionalObstacle (core/sdk/functional_obstacle.hpp).
/// Vectors first <= p < last are those of one segment; pointers of x, from, to... are to whole vectors, B per vector.
template <int B>
class Nonlinearity {
 public:
  virtual ~Nonlinearity();

  /// phi(to) - phi(from), computed without cancellation: it is compared with gains near rounding.
  virtual double change(const LevelView<B>& level, Index first, Index last, const double* from,
                        const double* to) const noexcept = 0;

  /// Derivative of phi at `at` along `step`, to that side.
  virtual double slope(const LevelView<B>& level, Index first, Index last, const double* at,
                       const double* step) const noexcept = 0;

  /// Gradient and Hessian of the smooth piece at level.x, where they hold, and the components that are not smooth.
  virtual void linearise(const LevelView<B>& level, Index first, Index last,
                         const Linearisation<B>& out) const noexcept = 0;

  /// Whether phi depends on the solution, and with it the data that renew() writes.
  virtual bool follows_solution() const noexcept;

  /// Renews data that are frozen during a cycle from the iterate level.x and r = b - A x, as the normal force in
  /// Coulomb's bound. @param data written like LevelView::data, which it need not be
  virtual void renew(const LevelView<B>& level, Index first, Index last, const double* r, double* data) const noexcept;

  /// Makes data of one slot those of phi at a vertex that stands for `ratio` times as much of the surface, as vectors
  /// of a coarser level do. @return false: that is not known, and starts on coarser levels of a matrix go without phi
  virtual bool scale(double ratio, double* data) const noexcept;

  /// Where phi is friction on the tangential components its law, for methods with a formulation of their own.
  /// @param data of one slot
  /// @return false: it is anything else
  virtual bool friction(const double* data, FrictionLaw& law) const noexcept;
};

}  // namespace signorini
