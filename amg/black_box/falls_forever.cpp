#include "amg/black_box/falls_forever.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/energy_along.hpp"
#include "core/base/rounding.hpp"

namespace signorini {
namespace {

constexpr double slight = 1e-8;  // components of d and work along it, relative to the largest possible

template <int B>
bool meets_a_bound(const Constraints<B>& c, const std::vector<double>& d, double small) {
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const double component = d[Offset{c.vector[slot]} * B + k];
      if (component < -small && c.lower[Offset{slot} * B + k] > -infinity) return true;
      if (component > small && c.upper[Offset{slot} * B + k] < infinity) return true;
    }
  return false;
}

}  // namespace

template <int B>
bool falls_forever(const DiscreteProblem<B>& problem, const std::vector<double>& d) {
  double work = 0, terms = 0, largest = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    work += problem.b[i] * d[i];
    terms += std::abs(problem.b[i] * d[i]);
    largest = std::max(largest, std::abs(d[i]));
  }
  if (!(work > slight * terms) || meets_a_bound(problem.constraints, d, slight * largest)) return false;
  const EnergyAlong energy = energy_along(problem.A, d);
  // of d'Ad, relative to d'Dd with the diagonal D of A
  return energy.of_matrix <= rounding_of_sums * energy.of_diagonal;
}

template bool falls_forever(const DiscreteProblem<1>&, const std::vector<double>&);
template bool falls_forever(const DiscreteProblem<2>&, const std::vector<double>&);
template bool falls_forever(const DiscreteProblem<3>&, const std::vector<double>&);

}  // namespace signorini
