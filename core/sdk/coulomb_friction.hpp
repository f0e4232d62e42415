#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/sdk/given_friction_solver.hpp"

namespace signorini {

/// Friction by Coulomb's law: the tangential force is at most mu times the force that presses, and as large as that
/// where the vertex slips. While the bound is frozen it is friction with a given bound. Of Slot::data the first number
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

/// Its local solver: with a frozen bound that of GivenFriction; else such that the bound fits the force that presses
/// then.
template <int B>
struct CoulombSolver {
  static void minimise(const Slot<B>& slot, const double* M, const double* r, const double* x, double* y) {
    if (slot.frozen || !(slot.data[1] > 0) || normal_component(slot) < 0)
      GivenFrictionSolver<B>::minimise(slot, M, r, x, y);
    else
      LocalLaw{slot, M, r, x, y}.solve();
  }

 private:
  /// The bound g at which mu times the force that presses, for the minimiser y with that bound, is g. The difference is
  /// positive or zero at g = 0 and negative for large g, so that there is such a g; for small mu it falls and there is
  /// no other.
  struct LocalLaw {
    static constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    static constexpr int most_steps = 200;

    const Slot<B>& slot;
    const double *M, *r, *x;
    double* y;
    double scale = 0;  // of what is compared

    void solve() {
      double low = 0, high = slot.data[0], at_high = excess(high);
      if (is_zero(at_high)) return;
      double at_low = at_high;
      if (at_high > 0) {  // a larger bound presses more at most up to a limit
        do {
          low = high;
          at_low = at_high;
          high += 2 * at_high;
          at_high = excess(high);
          if (is_zero(at_high) || !std::isfinite(high)) return;
        } while (at_high > 0);
      } else {
        at_low = excess(0);
        if (is_zero(at_low)) return;
      }
      find_root(low, at_low, high, at_high);
    }

    /// mu times the force that presses on the minimiser for the bound g, less g.
    double excess(double g) {
      const double data[] = {g, slot.data[1]};
      Slot<B> given = slot;
      given.data = data;
      GivenFrictionSolver<B>::minimise(given, M, r, x, y);
      double left[B], d[B];
      for (int k = 0; k < B; ++k) {
        d[k] = y[k] - x[k];
        left[k] = r[k];
      }
      block::subtract_product<B>(M, d, left);
      const double now = CoulombFriction<B>::bound(given, M, left, y);
      scale = std::max(now, g);
      const int k = normal_component(slot);
      for (int j = 0; j < B; ++j) scale = std::max(scale, slot.data[1] * std::abs(M[k * B + j] * d[j]));
      return now - g;
    }

    bool is_zero(double difference) const { return std::abs(difference) <= rounding * scale; }

    /// Between bounds with differences of both signs: by secants, halved where one end stays (Illinois).
    void find_root(double a, double at_a, double b, double at_b) {
      for (int k = 0; k < most_steps; ++k) {
        double c = k % 8 == 7 ? 0.5 * (a + b) : b - at_b * (b - a) / (at_b - at_a);
        if (!(c > std::min(a, b) && c < std::max(a, b))) c = 0.5 * (a + b);
        const double at_c = excess(c);
        if (is_zero(at_c) || c == a || c == b) return;
        if ((at_c > 0) != (at_b > 0))
          a = b, at_a = at_b;
        else
          at_a *= 0.5;
        b = c;
        at_b = at_c;
      }
    }
  };
};

}  // namespace signorini
