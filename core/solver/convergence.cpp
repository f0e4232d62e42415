#include "core/solver/convergence.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/products.hpp"

namespace signorini {

void ErrorEstimate::add(double gain, double correction) {
  gain = std::max(gain, 0.0);
  constexpr double slowest = 0.999;
  // Until there are two gains: as if every cycle halved the error.
  double ratio = 0.25;
  if (!gains_.empty() && gains_.back() > 0) ratio = std::min(gain / gains_.back(), slowest);
  error_ = std::sqrt(2 * gain * ratio / (1 - ratio));
  gains_.push_back(gain);
  corrections_.push_back(correction);
}

double ErrorEstimate::rate() const {
  const std::size_t n = corrections_.size(), window = std::min<std::size_t>(4, n ? n - 1 : 0);
  if (window == 0 || !(corrections_[n - 1 - window] > 0)) return 0;
  return std::pow(corrections_[n - 1] / corrections_[n - 1 - window], 1.0 / static_cast<double>(window));
}

namespace {

struct Products {
  double xAx, bx;
};

// Sums over the free components: A x = b - r there, with b and A already without the prescribed values.
template <int B>
Products free_products(const DiscreteProblem<B>& problem, const std::vector<double>& x, const std::vector<double>& r) {
  Products sum{0, 0};
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int k = 0; k < B; ++k) {
      if (problem.fixed[p] >> k & 1u) continue;
      const Offset i = Offset{p} * B + k;
      sum.xAx += x[i] * (problem.b[i] - r[i]);
      sum.bx += x[i] * problem.b[i];
    }
  return sum;
}

template <int B>
double coupling(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  double sum = 0;
  for (std::size_t c = 0; c < problem.coupled.size(); ++c)
    for (int k = 0; k < B; ++k) sum += x[Offset{problem.coupled[c]} * B + k] * problem.coupling[c * B + k];
  return sum;
}

}  // namespace

template <int B>
double energy_norm_squared(const DiscreteProblem<B>& problem, const std::vector<double>& x,
                           const std::vector<double>& r) {
  const double squared = free_products(problem, x, r).xAx + 2 * coupling(problem, x) + problem.prescribed_energy;
  return std::max(squared, 0.0);
}

template <int B>
double energy(const DiscreteProblem<B>& problem, const std::vector<double>& x, const std::vector<double>& r) {
  const Products p = free_products(problem, x, r);  // b holds -A g already
  return 0.5 * p.xAx - p.bx + 0.5 * problem.prescribed_energy - problem.prescribed_work;
}

template <int B>
double energy(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  std::vector<double> r(x.size());
  residual(problem.A, x.data(), problem.b.data(), r.data());
  return energy(problem, x, r);
}

template double energy_norm_squared(const DiscreteProblem<1>&, const std::vector<double>&, const std::vector<double>&);
template double energy_norm_squared(const DiscreteProblem<2>&, const std::vector<double>&, const std::vector<double>&);
template double energy_norm_squared(const DiscreteProblem<3>&, const std::vector<double>&, const std::vector<double>&);
template double energy(const DiscreteProblem<1>&, const std::vector<double>&, const std::vector<double>&);
template double energy(const DiscreteProblem<1>&, const std::vector<double>&);
template double energy(const DiscreteProblem<2>&, const std::vector<double>&, const std::vector<double>&);
template double energy(const DiscreteProblem<2>&, const std::vector<double>&);
template double energy(const DiscreteProblem<3>&, const std::vector<double>&, const std::vector<double>&);
template double energy(const DiscreteProblem<3>&, const std::vector<double>&);

}  // namespace signorini
