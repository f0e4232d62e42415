#include "core/solver/recombination.hpp"

#include <algorithm>

namespace signorini {

template <int B>
bool Recombination<B>::propose(const std::vector<double>& x_before, const std::vector<double>& r_before,
                               const std::vector<double>& x, const std::vector<double>& r) {
  const std::size_t n = x.size();
  next_ = (next_ + 1) % (depth + 1);
  newest().p.resize(n);
  newest().Ap.resize(n);
  // What is not known yet counts with the weight zero.
  const double *p1 = newest().p.data(), *Ap1 = p1, *p2 = p1, *Ap2 = p1;
  if (known_ > 0) p1 = older(1).p.data(), Ap1 = older(1).Ap.data();
  if (known_ > 1) p2 = older(2).p.data(), Ap2 = older(2).Ap.data();
  const double *from = x_before.data(), *r_from = r_before.data(), *to = x.data(), *r_to = r.data();
  double cycle_gain = 0, beta1 = 0, beta2 = 0;
#pragma omp simd reduction(+ : cycle_gain, beta1, beta2)
  for (std::size_t i = 0; i < n; ++i) {
    const double d = to[i] - from[i];
    cycle_gain += 0.5 * d * (r_from[i] + r_to[i]);
    beta1 += d * Ap1[i];
    beta2 += d * Ap2[i];
  }
  beta1 = known_ > 0 ? beta1 / older(1).energy : 0;
  beta2 = known_ > 1 ? beta2 / older(2).energy : 0;
  double *p = newest().p.data(), *Ap = newest().Ap.data();
  double force = 0, energy = 0;
#pragma omp simd reduction(+ : force, energy)
  for (std::size_t i = 0; i < n; ++i) {
    const double d = to[i] - from[i] - beta1 * p1[i] - beta2 * p2[i];
    const double Ad = r_from[i] - r_to[i] - beta1 * Ap1[i] - beta2 * Ap2[i];
    p[i] = d;
    Ap[i] = Ad;
    force += d * r_from[i];
    energy += d * Ad;
  }
  newest().energy = energy;
  step_ = force / energy;
  if (!(energy > 0) || !(0.5 * step_ * force >= cycle_gain) || !admissible(x_before)) {
    reset();
    return false;
  }
  known_ = std::min(known_ + 1, depth);
  return true;
}

template <int B>
void Recombination<B>::combine(const std::vector<double>& x_before, const std::vector<double>& r_before, Index first,
                               Index last, std::vector<double>& x, std::vector<double>& r) const {
  const double *from = x_before.data(), *r_from = r_before.data(), *p = newest().p.data(), *Ap = newest().Ap.data();
  double *to = x.data(), *r_to = r.data();
  for (Offset i = Offset{first} * B; i < Offset{last} * B; ++i) {
    to[i] = from[i] + step_ * p[i];
    r_to[i] = r_from[i] - step_ * Ap[i];
  }
}

template <int B>
bool Recombination<B>::admissible(const std::vector<double>& x_before) const {
  for (std::size_t slot = 0; slot < constraints_.vector.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{constraints_.vector[slot]} * B + k;
      const double x = x_before[i] + step_ * newest().p[i];
      if (!(x >= constraints_.lower[slot * B + k] && x <= constraints_.upper[slot * B + k])) return false;
    }
  return true;
}

template class Recombination<1>;
template class Recombination<2>;
template class Recombination<3>;

}  // namespace signorini
