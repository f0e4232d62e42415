#include "amg/black_box/go_on.hpp"

#include <cmath>

#include "core/algebra/energy_along.hpp"
#include "core/algebra/products.hpp"
#include "core/base/dot.hpp"
#include "core/solver/admissible.hpp"

namespace signorini {
namespace {

/// Without components that are prescribed, or that bounds hold at x, where the forces are r.
template <int B>
std::vector<double> free_part(const DiscreteProblem<B>& problem, const std::vector<double>& x,
                              const std::vector<double>& r, std::vector<double> d) {
  for (std::size_t i = 0; i < d.size(); ++i)
    if (problem.fixed[i / B] >> (i % B) & 1u) d[i] = 0;
  const Constraints<B>& c = problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{c.vector[slot]} * B + k, at = Offset{slot} * B + k;
      if ((x[i] <= c.lower[at] && r[i] < 0) || (x[i] >= c.upper[at] && r[i] > 0)) d[i] = 0;
    }
  return d;
}

}  // namespace

template <int B>
void go_on(const DiscreteProblem<B>& problem, const std::vector<double>& way, std::vector<double>& x) {
  if (x.empty() || way.size() != x.size()) return;
  make_admissible(problem, x);
  std::vector<double> r(x.size());
  residual<B>(problem.A, x.data(), problem.b.data(), r.data());
  const std::vector<double> d = free_part(problem, x, r, way);
  const EnergyAlong energy = energy_along(problem.A, d);
  const std::vector<double> start = x;
  const auto try_step = [&](double length, const std::vector<double>& along) {
    std::vector<double> other = start;
    for (std::size_t i = 0; i < other.size(); ++i) other[i] += length * along[i];
    make_admissible(problem, other);
    if (lowers(problem, other, x)) x = std::move(other);
  };
  if (energy.of_matrix > rounding_of_energy * energy.of_diagonal) try_step(dot(d, r) / energy.of_matrix, d);
  try_step(1, way);
}

template void go_on(const DiscreteProblem<1>&, const std::vector<double>&, std::vector<double>&);
template void go_on(const DiscreteProblem<2>&, const std::vector<double>&, std::vector<double>&);
template void go_on(const DiscreteProblem<3>&, const std::vector<double>&, std::vector<double>&);

}  // namespace signorini
