#pragma once
#include <vector>

#include "core/fem/assembly/discretize.hpp"

namespace signorini {

/// A problem as seen by a body that has moved rigidly: what is sought is what is left of its displacement. A stiff body
/// falls far and deforms little. Rounding of the whole way would hide the forces that deform it, and a residual of the
/// size of that rounding would be all that iterations can reach; what is left has only its own.
template <int B>
class MovedProblem {
 public:
  /// Takes `way` off prescribed values, bounds and x. Keeps references to discretization and x until back(), which is
  /// called once. Where nothing else is left to do, x becomes zero, and so does the start of a pressure.
  /// @param way a motion without energy, local coordinates; empty: none
  MovedProblem(Discretization<B>& discretization, std::vector<double> way, std::vector<double>& x,
               std::vector<double>& pressure);

  /// The problem as it was, without a load that follows the solution, and x with the way added. What is at a bound
  /// stays there.
  /// @return what rounding of stiffness times way does to the forces on the body, over those that act; 0 where it
  /// is next to nothing
  double back();

 private:
  Discretization<B>& discretization_;
  std::vector<double> way_;
  std::vector<double>& x_;
  std::vector<double> prescribed_, lower_, upper_;  // of the problem as it was
  std::vector<Facet<B>> facet_;
};

}  // namespace signorini
