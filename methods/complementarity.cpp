#include "methods/complementarity.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {

template <int B>
typename Complementarity<B>::State Complementarity<B>::evaluate(const double* v, const double* f, double* C,
                                                                double* by_force, double* by_value) const {
  State state;
  std::fill_n(by_force, B * B, 0.0);
  std::fill_n(by_value, B * B, 0.0);
  int normal = -1;
  bool all_rest = true;  // what is prescribed among the tangential components
  double trial = 0;
  for (int k = 0; k < B; ++k) {
    if (is(off, k)) {
      C[k] = f[k];
      by_force[k * (B + 1)] = 1;
      if (is(tangential, k) && v[k] != last[k]) all_rest = false;
    } else if (!is(tangential, k)) {
      bounds(k, v, f, state, C, by_force, by_value);
      if (normal < 0) normal = k;
    } else {
      const double t = f[k] - slip_stiffness * (v[k] - last[k]);
      trial += t * t;
    }
  }
  if (!tangential) return state;
  double g = law.bound, dg_force = 0, dg_value = 0;
  if (normal >= 0 && state.side[normal] < 0) {
    const bool held = lower[normal] == upper[normal];
    const double presses = held ? f[normal] : f[normal] - stiffness[normal] * (v[normal] - lower[normal]);
    g += law.coefficient * std::max(presses, 0.0);
    if (presses > 0) {
      dg_force = law.coefficient;
      dg_value = held ? 0 : -law.coefficient * stiffness[normal];
    }
  }
  if (all_rest && trial <= g * g) {
    state.friction = Friction::sticks;
    stick(v, C, by_value);
  } else {
    state.friction = Friction::slips;
    slip(v, f, g, normal, dg_force, dg_value, C, by_force, by_value);
  }
  return state;
}

template <int B>
void Complementarity<B>::bounds(int k, const double* v, const double* f, State& state, double* C, double* by_force,
                                double* by_value) const {
  const double c = stiffness[k], below = f[k] - c * (v[k] - lower[k]), above = f[k] - c * (v[k] - upper[k]);
  if (lower[k] == upper[k] || below >= 0 || above <= 0) {
    const bool at_lower = lower[k] == upper[k] || below >= 0;
    state.side[k] = at_lower ? -1 : 1;
    C[k] = c * (v[k] - (at_lower ? lower[k] : upper[k]));
    by_value[k * (B + 1)] = c;
  } else {
    C[k] = f[k];
    by_force[k * (B + 1)] = 1;
  }
}

template <int B>
void Complementarity<B>::stick(const double* v, double* C, double* by_value) const {
  for (int k = 0; k < B; ++k) {
    if (!is(tangential, k) || is(off, k)) continue;
    C[k] = slip_stiffness * (v[k] - last[k]);
    by_value[k * (B + 1)] = slip_stiffness;
  }
}

// The force is g along the trial f - c (v - last); where part of the slip is prescribed, against the slip itself.
template <int B>
void Complementarity<B>::slip(const double* v, const double* f, double g, int normal, double dg_force, double dg_value,
                              double* C, double* by_force, double* by_value) const {
  bool guided = false;
  for (int k = 0; k < B; ++k) guided = guided || (is(tangential, k) && is(off, k) && v[k] != last[k]);
  double direction[B] = {}, length = 0;
  for (int k = 0; k < B; ++k) {
    if (!is(tangential, k) || (is(off, k) && !guided)) continue;
    direction[k] = guided ? last[k] - v[k] : f[k] - slip_stiffness * (v[k] - last[k]);
    length += direction[k] * direction[k];
  }
  length = std::sqrt(length);
  for (double& d : direction) d = length > 0 ? d / length : 0;
  for (int k = 0; k < B; ++k) {
    if (!is(tangential, k) || is(off, k)) continue;
    C[k] = f[k] - g * direction[k];
    by_force[k * (B + 1)] = 1;
    if (normal >= 0) {
      by_force[k * B + normal] -= dg_force * direction[k];
      by_value[k * B + normal] -= dg_value * direction[k];
    }
    if (!(length > 0)) continue;
    for (int j = 0; j < B; ++j) {
      if (!is(tangential, j) || is(off, j)) continue;
      const double turns = g / length * ((k == j ? 1 : 0) - direction[k] * direction[j]);
      if (!guided) by_force[k * B + j] -= turns;
      by_value[k * B + j] += guided ? turns : turns * slip_stiffness;
    }
  }
}

template struct Complementarity<1>;
template struct Complementarity<2>;
template struct Complementarity<3>;

}  // namespace signorini
