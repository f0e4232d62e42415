#pragma once
#include <vector>

#include "core/algebra/products.hpp"
#include "core/solver/functional.hpp"

namespace signorini {

/// The admissible vector next to x (B per vector, local coordinates): prescribed values and bounds.
template <int B>
void make_admissible(const DiscreteProblem<B>& problem, std::vector<double>& x) {
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) x[Offset{p} * B + k] = problem.start[Offset{p} * B + k];
  const Constraints<B>& c = problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) c.project(slot, x.data() + Offset{c.vector[slot]} * B);
}

/// J(a) - J(b) <= 0 of admissible vectors, without cancellation: J(a) - J(b) = -(a - b)'r with the residual r in the
/// middle between them.
template <int B>
bool lowers(const DiscreteProblem<B>& problem, const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> middle(a.size()), r(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) middle[k] = 0.5 * (a[k] + b[k]);
  residual<B>(problem.A, middle.data(), problem.b.data(), r.data());
  double gain = 0;
  for (std::size_t k = 0; k < a.size(); ++k) gain += (a[k] - b[k]) * r[k];
  return gain - functional::change(problem, b.data(), a.data()) >= 0;
}

}  // namespace signorini
