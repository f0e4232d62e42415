#pragma once
#include <algorithm>
#include <cmath>

#include "core/sdk/functional_obstacle.hpp"

namespace signorini {

/// The component that is not tangential; -1: it is prescribed.
template <int B>
int normal_component(const Slot<B>& slot) {
  for (int k = 0; k < B; ++k)
    if (!(slot.tangential >> k & 1u)) return slot.lower[k] == slot.upper[k] ? -1 : k;
  return -1;
}

/// The local solver of GivenFriction. The normal component is eliminated, which leaves a problem for the tangential
/// ones alone; where the normal component then is beyond a bound, it lies on it.
template <int B>
struct GivenFrictionSolver {
  static void minimise(const Slot<B>& slot, const double* M, const double* r, const double* x, double* y) {
    const int normal = normal_component(slot);
    for (int k = 0; k < B; ++k) y[k] = slot.lower[k] == slot.upper[k] ? slot.lower[k] : x[k];
    const bool moves = normal >= 0 && M[normal * (B + 1)] > 0;
    slide(slot, M, r, x, moves ? normal : -1, y);
    if (!moves || (y[normal] >= slot.lower[normal] && y[normal] <= slot.upper[normal])) return;
    y[normal] = y[normal] < slot.lower[normal] ? slot.lower[normal] : slot.upper[normal];
    slide(slot, M, r, x, -1, y);
  }

 private:
  /// Minimises over the free tangential components of y, and over component `free` with them unless that is -1; the
  /// others stay.
  static void slide(const Slot<B>& slot, const double* M, const double* r, const double* x, int free, double* y) {
    int at[B], count = 0;
    double resting = 0;  // the square of what is prescribed
    for (int k = 0; k < B; ++k) {
      if (!(slot.tangential >> k & 1u)) continue;
      if (slot.lower[k] == slot.upper[k])
        resting += (y[k] - slot.last[k]) * (y[k] - slot.last[k]);
      else
        at[count++] = k;
    }
    // What moves apart from these: forces are r - M (y - x), with the components sought taken as unmoved.
    double rest[B];
    for (int i = 0; i < B; ++i) {
      rest[i] = r[i];
      for (int j = 0; j < B; ++j)
        if (j != free && !is_among(at, count, j)) rest[i] -= M[i * B + j] * (y[j] - x[j]);
    }
    double S[4] = {}, q[2] = {}, from[2] = {}, step[2] = {};
    for (int a = 0; a < count; ++a) {
      q[a] = rest[at[a]];
      if (free >= 0) q[a] -= M[at[a] * B + free] / M[free * (B + 1)] * rest[free];
      for (int b = 0; b < count; ++b) {
        S[a * 2 + b] = M[at[a] * B + at[b]];
        if (free >= 0) S[a * 2 + b] -= M[at[a] * B + free] / M[free * (B + 1)] * M[free * B + at[b]];
      }
    }
    for (int a = 0; a < count; ++a) from[a] = x[at[a]] - slot.last[at[a]];
    if (minimise_sliding(S, q, from, count, slot.data[0], resting, step))
      for (int a = 0; a < count; ++a) y[at[a]] = x[at[a]] + step[a];
    else
      for (int a = 0; a < count; ++a) y[at[a]] = slot.last[at[a]] + step[a];
    if (free < 0) return;
    double force = rest[free];
    for (int a = 0; a < count; ++a) force -= M[free * B + at[a]] * (y[at[a]] - x[at[a]]);
    y[free] = x[free] + force / M[free * (B + 1)];
  }

  static bool is_among(const int* at, int count, int k) {
    for (int a = 0; a < count; ++a)
      if (at[a] == k) return true;
    return false;
  }

  /// Minimises 1/2 d'Sd - q'd + g sqrt(|w|^2 + resting) for the slip w = from + d, up to two components. The step is
  /// the shorter one of d and w, which leaves less of it to rounding: whether it is d.
  static bool minimise_sliding(const double* S, const double* q, const double* from, int count, double g,
                               double resting, double* step) {
    if (count == 0) return false;
    double axis[2] = {1, 0}, s[2] = {S[0], S[3]};  // S = s[0] a a' + s[1] b b' with a = axis, b = axis turned
    if (count == 2 && S[1] != 0) {
      const double angle = 0.5 * std::atan2(2 * S[1], S[0] - S[3]), c = std::cos(angle), d = std::sin(angle);
      axis[0] = c;
      axis[1] = d;
      s[0] = c * c * S[0] + 2 * c * d * S[1] + d * d * S[3];
      s[1] = d * d * S[0] - 2 * c * d * S[1] + c * c * S[3];
    }
    const double force[2] = {axis[0] * q[0] + axis[1] * q[1], axis[0] * q[1] - axis[1] * q[0]};
    const double p[2] = {force[0] + s[0] * (axis[0] * from[0] + axis[1] * from[1]),
                         force[1] + s[1] * (axis[0] * from[1] - axis[1] * from[0])};
    if (resting == 0 && std::hypot(p[0], p[1]) <= g) return false;  // w = 0: it sticks
    const double length = g > 0 ? sliding_length(s, p, count, g, resting) : 1;
    double slip[2] = {}, change[2] = {};
    bool stiff = true;
    for (int a = 0; a < count; ++a) {
      const double stiffness = s[a] * length + g;
      slip[a] = stiffness > 0 ? p[a] * length / stiffness : 0;
      stiff = stiff && s[a] > 0;
      if (stiff) change[a] = (force[a] - g * slip[a] / length) / s[a];
    }
    const bool moved = stiff && std::hypot(change[0], change[1]) < std::hypot(slip[0], slip[1]);
    const double* t = moved ? change : slip;
    step[0] = axis[0] * t[0] - axis[1] * t[1];
    step[1] = axis[1] * t[0] + axis[0] * t[1];
    return moved;
  }

  /// The length l of the whole vector, at which |w(l)|^2 + resting = l^2 for w(l) = l (S l + g)^-1 p: the root of a
  /// decreasing convex function, from its left by Newton's method. The start is the length that the largest stiffness
  /// would leave: from zero p / g overflows where the bound g is tiny.
  static double sliding_length(const double* s, const double* p, int count, double g, double resting) {
    const double stiffest = count == 2 ? std::max(s[0], s[1]) : s[0];
    double l = std::sqrt(resting);
    if (stiffest > 0) l = std::max(l, (std::hypot(p[0], count == 2 ? p[1] : 0) - g) / stiffest);
    for (int k = 0; k < 100; ++k) {
      double f = l > 0 ? resting / (l * l) - 1 : -1, slope = l > 0 ? -2 * resting / (l * l * l) : 0;
      for (int a = 0; a < count; ++a) {
        const double stiffness = s[a] * l + g, part = p[a] / stiffness;
        f += part * part;
        slope -= 2 * part * part * s[a] / stiffness;
      }
      if (!(f > 0) || !(slope < 0)) break;
      const double next = l - f / slope;
      if (!(next > l)) break;
      const bool close = next - l <= 1e-15 * next;
      l = next;
      if (close) break;
    }
    return l;
  }
};

}  // namespace signorini
