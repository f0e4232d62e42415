#pragma once
#include <algorithm>
#include <cmath>

#include "core/solver/discrete_problem.hpp"
#include "tests/support/convex.hpp"

namespace signorini::test {

/// For convex_minimiser(): bounds and friction with a given bound at every slot, in the Euclidean norm; prescribed
/// components by bisection along the free one.
template <int B>
auto friction_prox(const DiscreteProblem<B>& problem) {
  return [&problem](double rho, Eigen::VectorXd& y) {
    const Constraints<B>& c = problem.constraints;
    for (Index p = 0; p < problem.A.size(); ++p)
      for (int k = 0; k < B; ++k)
        if (problem.fixed[p] >> k & 1u) y[p * B + k] = problem.start[p * B + k];
    for (Index slot = 0; slot < c.size(); ++slot) {
      const double *last = c.last.data() + slot * B, *lower = c.lower.data() + slot * B,
                   *upper = c.upper.data() + slot * B;
      double* v = y.data() + c.vector[slot] * B;
      const double g = c.data[slot * c.width] / rho;
      int free[B], count = 0;
      double rest = 0;
      for (int k = 0; k < B; ++k) {
        v[k] = std::clamp(v[k], lower[k], upper[k]);
        if (!(c.tangential[slot] >> k & 1u)) continue;
        if (lower[k] == upper[k])
          rest = std::hypot(rest, v[k] - last[k]);
        else
          free[count++] = k;
      }
      if (count == 1 && rest > 0) {
        const double z = v[free[0]] - last[free[0]];
        double low = -std::abs(z), high = std::abs(z);
        for (int k = 0; k < 200; ++k) {
          const double t = 0.5 * (low + high);
          ((t - z) + g * t / std::hypot(t, rest) > 0 ? high : low) = t;
        }
        v[free[0]] = last[free[0]] + 0.5 * (low + high);
        continue;
      }
      double length = 0;
      for (int k = 0; k < count; ++k) length = std::hypot(length, v[free[k]] - last[free[k]]);
      for (int k = 0; k < count; ++k)
        v[free[k]] = last[free[k]] + (length > g ? 1 - g / length : 0) * (v[free[k]] - last[free[k]]);
    }
  };
}

}  // namespace signorini::test
