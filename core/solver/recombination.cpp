#include "core/solver/recombination.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {

template <int B>
void Recombination<B>::add(const std::vector<double>& x_before, const std::vector<double>& x, Index first, Index last) {
  for (int age = 0; age < known_; ++age) {
    const double *from = x_before.data(), *to = x.data(), *Ap = aged(age).Ap.data();
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (Offset i = Offset{first} * B; i < Offset{last} * B; ++i) sum += (to[i] - from[i]) * Ap[i];
    along_[age] += sum;
  }
}

template <int B>
bool Recombination<B>::propose(const std::vector<double>& x_before, const std::vector<double>& r_before,
                               const std::vector<double>& x, const std::vector<double>& r, double cycle_gain) {
  const std::size_t n = x.size();
  next_ = (next_ + 1) % depth;
  Direction& newest = directions_[next_];
  newest.p.resize(n);
  newest.Ap.resize(n);
  double *p = newest.p.data(), *Ap = newest.Ap.data();
  // What is not known yet counts with the weight zero.
  const double *p1 = p, *Ap1 = p;
  double beta1 = 0, beta2 = 0;
  if (known_ > 0) p1 = aged(1).p.data(), Ap1 = aged(1).Ap.data(), beta1 = along_[0] / aged(1).energy;
  if (known_ > 1) beta2 = along_[1] / newest.energy;  // which is the oldest one until then
  const double *from = x_before.data(), *r_from = r_before.data(), *to = x.data(), *r_to = r.data();
  double force = 0, energy = 0;
#pragma omp simd reduction(+ : force, energy)
  for (std::size_t i = 0; i < n; ++i) {
    const double d = to[i] - from[i] - beta1 * p1[i] - beta2 * p[i];
    const double Ad = r_from[i] - r_to[i] - beta1 * Ap1[i] - beta2 * Ap[i];
    p[i] = d;
    Ap[i] = Ad;
    force += d * r_from[i];
    energy += d * Ad;
  }
  newest.energy = energy;
  newest.beta1 = beta1;
  newest.beta2 = beta2;
  double noise = 1;  // of the residuals in Ap but for r_before
  if (known_ > 0) noise += std::abs(beta1) * aged(1).noise;
  if (known_ > 1) noise += std::abs(beta2) * newest.noise;
  newest.noise = noise + carried_;
  step_ = force / energy;
  if (!(energy > 0) || !(0.5 * step_ * force >= cycle_gain)) return false;
  carried_ = std::abs(1 - step_) * carried_ + std::abs(step_) * noise;
  known_ = std::min(known_ + 1, depth);
  return true;
}

template <int B>
void Recombination<B>::add_residuals(const std::vector<double>& r_before, const std::vector<double>& r) {
  Direction& newest = directions_[next_];
  newest.of_residual.resize(r.size());
  double* out = newest.of_residual.data();
  // Where there is no direction before, its weight is zero. The oldest one's part is in the newest one's place.
  const double *from = r_before.data(), *to = r.data();
  const double* one = aged(1).of_residual.empty() ? out : aged(1).of_residual.data();
#pragma omp simd
  for (std::size_t i = 0; i < r.size(); ++i) out[i] = from[i] - to[i] - newest.beta1 * one[i] - newest.beta2 * out[i];
}

template <int B>
bool Recombination<B>::combine(const std::vector<double>& x_before, const std::vector<double>& r_before, Index first,
                               Index last, std::vector<double>& x, std::vector<double>& r) const {
  const double *from = x_before.data(), *r_from = r_before.data(), *p = aged(0).p.data();
  const double* Ap = aged(0).of_residual.empty() ? aged(0).Ap.data() : aged(0).of_residual.data();
  double *to = x.data(), *r_to = r.data();
  for (Offset i = Offset{first} * B; i < Offset{last} * B; ++i) {
    to[i] = from[i] + step_ * p[i];
    r_to[i] = r_from[i] - step_ * Ap[i];
  }
  return admissible(x, first, last);
}

template <int B>
bool Recombination<B>::admissible(const std::vector<double>& x, Index first, Index last) const {
  const Constraints<B>& c = constraints_;
  const auto begin = std::lower_bound(c.vector.begin(), c.vector.end(), first);
  const auto end = std::lower_bound(begin, c.vector.end(), last);
  for (auto slot = static_cast<std::size_t>(begin - c.vector.begin());
       slot < static_cast<std::size_t>(end - c.vector.begin()); ++slot)
    if (!c.admits(static_cast<Index>(slot), x.data() + Offset{c.vector[slot]} * B)) return false;
  return true;
}

template class Recombination<1>;
template class Recombination<2>;
template class Recombination<3>;

}  // namespace signorini
