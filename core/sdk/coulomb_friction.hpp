#pragma once
#include <algorithm>

#include "core/sdk/given_friction_solver.hpp"

namespace signorini {

/// Friction by Coulomb's law: the tangential force is at most mu times the force that presses, and as large as that
/// where the vertex slips. During a cycle the bound is given, and it is GivenFriction. Of Slot::data the first number
/// is that bound, a force, the second one mu.
template <int B>
struct CoulombFriction {
  static constexpr int data = 2;

  /// The bound that follows from the iterate x and its residual r at the vertex: what does not press has none. The
  /// force that presses is that of the augmented Lagrangian (Alart and Curnier, Comput. Methods Appl. Mech. Eng. 92
  /// (1991) 353-375) with the vertex's own stiffness M: an iterate that is open by rounding alone presses nearly as
  /// much.
  static double bound(const Slot<B>& slot, const double* M, const double* r, const double* x) {
    const int k = normal_component(slot);
    return k < 0 ? 0 : slot.data[1] * std::max(0.0, -r[k] - M[k * (B + 1)] * std::max(0.0, x[k] - slot.lower[k]));
  }
};

}  // namespace signorini
