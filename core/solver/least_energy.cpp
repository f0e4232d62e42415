#include "core/solver/least_energy.hpp"

#include "core/algebra/products.hpp"
#include "core/solver/functional.hpp"

namespace signorini {

template <int B>
std::size_t least_energy(const DiscreteProblem<B>& problem, const std::vector<std::vector<double>>& vectors) {
  const std::vector<double>& first = vectors.front();
  std::vector<std::vector<double>> middle(vectors.size());
  for (std::size_t v = 1; v < vectors.size(); ++v) {
    middle[v].resize(first.size());
    for (std::size_t k = 0; k < first.size(); ++k) middle[v][k] = 0.5 * (vectors[v][k] + first[k]);
  }
  std::vector<double> gain(vectors.size());
  for (Index p = 0; p < problem.A.size(); ++p)
    for (std::size_t v = 1; v < vectors.size(); ++v) {
      double Ax[B];
      row_product(problem.A, p, middle[v].data(), Ax);
      for (int i = 0; i < B; ++i) {
        const Offset at = Offset{p} * B + i;
        gain[v] += (vectors[v][at] - first[at]) * (problem.b[at] - Ax[i]);
      }
    }
  const double* data = follows_solution(problem.segments) ? problem.constraints.before.data() : nullptr;
  for (std::size_t v = 1; v < vectors.size(); ++v)
    gain[v] -= functional::change(problem, first.data(), vectors[v].data(), data);
  std::size_t best = 0;
  for (std::size_t v = 1; v < vectors.size(); ++v)
    if (gain[v] >= gain[best]) best = v;
  return best;
}

template std::size_t least_energy(const DiscreteProblem<1>&, const std::vector<std::vector<double>>&);
template std::size_t least_energy(const DiscreteProblem<2>&, const std::vector<std::vector<double>>&);
template std::size_t least_energy(const DiscreteProblem<3>&, const std::vector<std::vector<double>>&);

}  // namespace signorini
