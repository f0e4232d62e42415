#pragma once
#include "estimators/certificate/bubbles.hpp"
#include "estimators/certificate/face_moments.hpp"

namespace signorini {

/// What obstacles exert on a finite element function, found from the residual at vertices, as forces that satisfy the
/// conditions of the true problem: never pulling, in the body divided among the elements around a vertex, on faces as
/// the linear pressure p = sum over i of (L_i / int phi_i) phi_i, and as linear tractions along them that are at most
/// what friction allows.
template <int D, int B>
struct Contact {
  ContactForces<D, B> forces;
  /// Per element: int p (v - bound), v with its bubbles, and int s |v_t| + t . v_t of friction, with its bound s, its
  /// traction t and the slip v_t; what contact adds to the bound.
  std::vector<double> work;
  double friction = 0;         ///< its part of `work`
  double friction_energy = 0;  ///< int s |v_t| of it
  /// Per element: the energy norm of a stress that the part of a pressure between bodies needs which is not linear on a
  /// face; empty: none.
  std::vector<double> oscillation;
  bool computed_constant = false;  ///< that norm is by a constant of which no proof is known
};

/// @param bubbles of v, as lift() and sweep() leave them
template <int D, int B>
Contact<D, B> contact_of(const TrueProblem<D, B>& problem, const Bubbles<D, B>& bubbles);

}  // namespace signorini
