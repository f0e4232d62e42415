#pragma once
#include <vector>

#include "core/fem/assembly/discretize.hpp"

namespace signorini {

/// The right-hand side of the loads and prescribed values of a discretization, without a load that follows the
/// solution, and what is known of reactions.
template <int B>
void place_loads(Discretization<B>& discretization);

/// A problem as seen by a body that has moved rigidly: what is sought is what is left of its displacement. A stiff body
/// falls far and deforms little. Rounding of the whole way would hide the forces that deform it, and a residual of the
/// size of that rounding would be all that iterations can reach; what is left has only its own.
template <int B>
class MovedProblem {
 public:
  /// Takes `way` off prescribed values, bounds and x, and adds to the loads what springs do against it. Keeps
  /// references to discretization and x until back(), which is called once. Where nothing else is left to do, x becomes
  /// zero, and so does the start of a pressure.
  /// @param way a motion that has no energy but in springs, local coordinates; empty: none
  /// @param of_springs what these exert on the nodes then, global coordinates; empty: nothing
  MovedProblem(Discretization<B>& discretization, std::vector<double> way, const std::vector<double>& of_springs,
               std::vector<double>& x, std::vector<double>& pressure);

  /// The problem as it was, without a load that follows the solution, and x with the way added. What is at a bound
  /// stays there.
  /// @return what rounding of stiffness times way does to the forces on the body, over those that act; 0 where it
  /// is next to nothing
  double back();

 private:
  Discretization<B>& discretization_;
  std::vector<double> way_;
  std::vector<double> load_;  // of the problem as it was; empty: the same
  std::vector<double>& x_;
  std::vector<double> prescribed_, lower_, upper_;  // of the problem as it was
  std::vector<Facet<B>> facet_;
};

}  // namespace signorini
