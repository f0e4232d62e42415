#pragma once
#include <vector>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// The admissible vector next to x (B per vector, local coordinates): prescribed values and bounds.
template <int B>
void make_admissible(const DiscreteProblem<B>& problem, std::vector<double>& x) {
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) x[Offset{p} * B + k] = problem.start[Offset{p} * B + k];
  const Constraints<B>& c = problem.constraints;
  for (std::size_t slot = 0; slot < c.vector.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const std::size_t at = slot * B + static_cast<std::size_t>(k);
      double& v = x[Offset{c.vector[slot]} * B + k];
      v = v < c.lower[at] ? c.lower[at] : v > c.upper[at] ? c.upper[at] : v;  // NaN stays visible
    }
}

}  // namespace signorini
