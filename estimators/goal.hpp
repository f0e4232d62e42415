#pragma once
#include <optional>
#include <vector>

#include "estimators/estimator.hpp"

namespace signorini {

/// A number that a solution is computed for. As long as contact and sticking stay as they are it depends linearly on
/// the solution x and on the forces A x - b that hold it,
///
///     value = of_solution . x + of_force . (A x - b) + a constant.
///
/// All is in the local coordinates of a discrete problem, B numbers per vector.
template <int B>
struct Quantity {
  double value = 0;
  std::vector<double> of_solution, of_force;
  std::vector<Flags> held;  ///< per vector the components that obstacles or friction hold, beside what is prescribed
};

/// The dual solution z of a goal, in global coordinates: a(v, z) is how the goal depends on each v that is zero where
/// contact holds it, and there z is what the goal asks of the forces, with the other sign. Nothing where `solve` could
/// not, or where all that the goal depends on is held: on a coarse mesh that says nothing.
/// @param problem with prescribed values that are eliminated
template <int B>
std::optional<std::vector<double>> dual_solution(const DiscreteProblem<B>& problem, const Quantity<B>& goal,
                                                 const LinearSolve<B>& solve);

/// How far off a goal is, dual-weighted: what the errors of a solution u and of the dual solution z have in common,
/// a(u - u_h, z - z_h), with an estimator that takes an error for how far stresses are from better ones. What it finds
/// is a square, and so of u + z and of u - z it finds the product, too.
/// @param by one whose shares are squares of what is linear in stresses: `recovery`, say
/// @return per element of the nodes, of either sign: what is missing of the goal
template <int D, int B>
std::vector<double> dual_weighted(const Estimator<D, B>& by, const Nodes<D>& nodes, const Model<B>& model,
                                  const std::vector<double>& u, const std::vector<double>& z);

/// About how large the error of a goal is, by the shares of elements. They add up, with their signs; but around the
/// edges of what is held those have no meaning: where an edge lies within an element is not known.
/// @param share dual_weighted()
template <int D, int B>
double goal_error(const Nodes<D>& nodes, const DiscreteProblem<B>& problem, const Quantity<B>& goal,
                  const std::vector<double>& share);

}  // namespace signorini
