#pragma once
#include <cmath>

#include "core/sdk/functional_obstacle.hpp"

namespace signorini {

/// phi(v) = g |v_T - l_T|: friction with a given bound g on the tangential force, the first number in Slot::data. v_T
/// are the tangential components, l_T those after the last load step. (Tresca friction: Duvaut and Lions, Inequalities
/// in mechanics and physics, 1976, chapter III.)
template <int B>
struct GivenFriction {
  static double change(const Slot<B>& slot, const double* from, const double* to) {
    double work = 0;
    for (int k = 0; k < B; ++k)
      if (slot.tangential >> k & 1u) work += (to[k] - from[k]) * ((to[k] - slot.last[k]) + (from[k] - slot.last[k]));
    const double sum = size(slot, from) + size(slot, to);
    return sum > 0 ? slot.data[0] * (work / sum) : 0;
  }

  static double slope(const Slot<B>& slot, const double* at, const double* step) {
    const double length = size(slot, at);
    if (length == 0) return slot.data[0] * tangential_size(slot, step);
    double product = 0;
    for (int k = 0; k < B; ++k)
      if (slot.tangential >> k & 1u) product += (at[k] - slot.last[k]) / length * step[k];
    return slot.data[0] * product;
  }

  /// How far v has slipped.
  static double size(const Slot<B>& slot, const double* v) {
    double sum = 0;
    for (int k = 0; k < B; ++k)
      if (slot.tangential >> k & 1u) sum += (v[k] - slot.last[k]) * (v[k] - slot.last[k]);
    return std::sqrt(sum);
  }

 private:
  static double tangential_size(const Slot<B>& slot, const double* v) {
    double sum = 0;
    for (int k = 0; k < B; ++k)
      if (slot.tangential >> k & 1u) sum += v[k] * v[k];
    return std::sqrt(sum);
  }
};

/// Its linearisation: what sticks is not smooth, and what slips is pulled back along its slip.
template <int B>
struct GivenFrictionModel {
  static void linearise(const Slot<B>& slot, const double* x, const QuadraticModel<B>& out) {
    const double g = slot.data[0], length = GivenFriction<B>::size(slot, x);
    if (!(g > 0)) return;
    for (int k = 0; k < B; ++k) {
      if (!(slot.tangential >> k & 1u)) continue;
      if (length == 0) {  // it sticks
        *out.critical |= static_cast<Flags>(1u << k);
        out.lower[k] = out.upper[k] = 0;
        continue;
      }
      const double slip = x[k] - slot.last[k], direction = slip / length;
      out.gradient[k] = g * direction;
      if constexpr (B == 3)
        for (int j = 0; j < B; ++j)
          if (slot.tangential >> j & 1u)
            out.hessian[k * B + j] = g / length * ((k == j ? 1 : 0) - direction * ((x[j] - slot.last[j]) / length));
    }
  }
};

}  // namespace signorini
