#pragma once

namespace signorini {

/// How far to go along a step: to where a convex energy has its minimum, up to the full step and to a tenth of the
/// slope at the start. The energy is nowhere above that of the start.
/// @param derivative derivative(t) of the energy at t in [0, 1] times the step, to the right
template <class Derivative>
double step_length(const Derivative& derivative) {
  constexpr double enough = 0.1;
  constexpr int most = 30;
  const double at_start = derivative(0.0);
  if (!(at_start < 0)) return 0;
  if (!(derivative(1.0) > 0)) return 1;
  double low = 0, high = 1;
  for (int k = 0; k < most; ++k) {
    const double middle = 0.5 * (low + high), slope = derivative(middle);
    (slope > 0 ? high : low) = middle;
    if (slope <= 0 && slope >= enough * at_start) break;
  }
  return low;
}

}  // namespace signorini
