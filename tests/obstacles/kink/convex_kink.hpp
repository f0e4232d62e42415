#pragma once
#include <algorithm>

#include "core/sdk/functional_obstacle.hpp"

namespace signorini::test {

/// phi(v) = s- (c-v)+ + s+ (v-c)+ + k-/2 (c-v)+^2 + k+/2 (v-c)+^2, convex where s- + s+ >= 0 and k-, k+ >= 0: a kink at
/// c between two quadratic pieces. Data: c, s-, s+, k-, k+.
struct ConvexKink {
  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    const auto [c, below, above, k_below, k_above] = read(slot);
    const double force = *r + *M * *x;  // 1/2 M y^2 - force y + phi(y)
    const double left = (force + below + k_below * c) / (*M + k_below),
                 right = (force - above + k_above * c) / (*M + k_above);
    *y = left < c ? left : right > c ? right : c;
    *y = *y < *slot.lower ? *slot.lower : *y > *slot.upper ? *slot.upper : *y;
  }

  static double change(const Slot<1>& slot, const double* from, const double* to) {
    const auto [c, below, above, k_below, k_above] = read(slot);
    const double step = *to - *from, sum = (*from - c) + (*to - c);  // on one side no other difference is taken
    if (*from >= c && *to >= c) return step * (above + 0.5 * k_above * sum);
    if (*from <= c && *to <= c) return step * (0.5 * k_below * sum - below);
    return change(slot, from, &c) + change(slot, &c, to);
  }

  static double slope(const Slot<1>& slot, const double* at, const double* step) {
    const auto [c, below, above, k_below, k_above] = read(slot);
    const bool right = *at > c || (*at == c && *step > 0);
    return *step * (right ? above + k_above * (*at - c) : -below - k_below * (c - *at));
  }

  static void linearise(const Slot<1>& slot, const double* x, const QuadraticModel<1>& out) {
    const auto [c, below, above, k_below, k_above] = read(slot);
    if (*x == c && below + above > 0) {
      *out.critical |= 1;
      *out.lower = *out.upper = 0;
    } else if (*x < c) {
      *out.gradient = -below - k_below * (c - *x);
      *out.hessian = k_below;
    } else {
      *out.gradient = above + k_above * (*x - c);
      *out.hessian = k_above;
    }
  }

 private:
  struct Numbers {
    double c, below, above, k_below, k_above;
  };
  static Numbers read(const Slot<1>& slot) {
    return {slot.data[0], slot.data[1], slot.data[2], slot.data[3], slot.data[4]};
  }
};

}  // namespace signorini::test
