#include "core/solver/convergence.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/products.hpp"

namespace signorini {

namespace {

constexpr double slowest = 0.999;  // ratio of steps that is believed

}  // namespace

void ErrorEstimate::add(double gain, double correction) {
  gain = std::abs(gain);           // a negative one is rounding, which hides as much
  constexpr double caution = 1.1;  // the last gains are the fast components', what is left the slow ones
  // Until there are two gains nothing is known of the rate: a middling one, 0.7.
  double ratio = 0.5;
  const std::size_t n = gains_.size();
  if (n > 0 && gains_[n - 1] > 0) ratio = gain / gains_[n - 1];
  if (n > 1 && gains_[n - 2] > 0)
    ratio = std::max(ratio, std::sqrt(gain / gains_[n - 2]));  // acceleration makes single ones uneven
  ratio = std::min(ratio, slowest);
  error_ = caution * std::sqrt(2 * gain * ratio / (1 - ratio));
  gains_.push_back(gain);
  corrections_.push_back(correction);
}

double ErrorEstimate::error_of_steps() const {
  const std::size_t n = corrections_.size();
  if (n == 0) return 0;
  double ratio = 0.7;
  if (n > 1 && corrections_[n - 2] > 0) ratio = corrections_[n - 1] / corrections_[n - 2];
  if (n > 2 && corrections_[n - 3] > 0) ratio = std::max(ratio, std::sqrt(corrections_[n - 1] / corrections_[n - 3]));
  ratio = std::min(ratio, slowest);
  return corrections_[n - 1] * ratio / (1 - ratio);
}

double ErrorEstimate::rate() const {
  std::size_t n = corrections_.size();
  while (n > 0 && !(corrections_[n - 1] > 0)) --n;  // what is lost in rounding has no rate
  const std::size_t window = std::min<std::size_t>(4, n ? n - 1 : 0);
  if (window == 0 || !(corrections_[n - 1 - window] > 0)) return unknown_rate;
  return std::pow(corrections_[n - 1] / corrections_[n - 1 - window], 1.0 / static_cast<double>(window));
}

template <int B>
FreeProducts free_products(const DiscreteProblem<B>& problem, const std::vector<double>& x,
                           const std::vector<double>& r, Index first, Index last) {
  double xAx = 0, bx = 0;
  const double *u = x.data(), *b = problem.b.data(), *res = r.data();
  const Flags* fixed = problem.fixed.data();
#pragma omp simd reduction(+ : xAx, bx)
  for (Index p = first; p < last; ++p)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{p} * B + k;
      const double free = fixed[p] >> k & 1u ? 0.0 : u[i];
      xAx += free * (b[i] - res[i]);
      bx += free * b[i];
    }
  return {xAx, bx};
}

namespace {

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
                           const FreeProducts& products) {
  const double squared = products.xAx + 2 * coupling(problem, x) + problem.prescribed_energy;
  return std::max(squared, 0.0);
}

template <int B>
double energy_norm_squared(const DiscreteProblem<B>& problem, const std::vector<double>& x,
                           const std::vector<double>& r) {
  return energy_norm_squared(problem, x, free_products(problem, x, r, 0, problem.A.size()));
}

template <int B>
double energy(const DiscreteProblem<B>& problem, const FreeProducts& products) {
  return 0.5 * products.xAx - products.bx +  // b holds -A g already
         0.5 * problem.prescribed_energy - problem.prescribed_work;
}

template <int B>
double energy(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  std::vector<double> r(x.size());
  residual(problem.A, x.data(), problem.b.data(), r.data());
  return energy(problem, free_products(problem, x, r, 0, problem.A.size()));
}

#define SIGNORINI_INSTANTIATE(B)                                                                                   \
  template FreeProducts free_products(const DiscreteProblem<B>&, const std::vector<double>&,                       \
                                      const std::vector<double>&, Index, Index);                                   \
  template double energy_norm_squared(const DiscreteProblem<B>&, const std::vector<double>&, const FreeProducts&); \
  template double energy_norm_squared(const DiscreteProblem<B>&, const std::vector<double>&,                       \
                                      const std::vector<double>&);                                                 \
  template double energy(const DiscreteProblem<B>&, const FreeProducts&);                                          \
  template double energy(const DiscreteProblem<B>&, const std::vector<double>&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
