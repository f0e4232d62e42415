#include "core/solver/recombination.hpp"

namespace signorini {

template <int B>
Recombination<B>::Recombination(const Constraints<B>& constraints, std::size_t unknowns) : constraints_(constraints) {
  for (Direction& d : directions_) {
    d.p.resize(unknowns);
    d.Ap.resize(unknowns);
  }
}

template <int B>
bool Recombination<B>::propose(const std::vector<double>& x_before, const std::vector<double>& r_before,
                               const std::vector<double>& x, const std::vector<double>& r, std::vector<double>& trial) {
  Direction& d = directions_[next_];
  const std::size_t n = x.size();
  std::array<const Direction*, depth> older{};
  std::array<double, depth> beta{};
  for (int k = 0; k < known_; ++k) older[k] = &directions_[(next_ + depth - k) % (depth + 1)];
  double cycle_gain = 0;
  for (std::size_t i = 0; i < n; ++i) {
    d.p[i] = x[i] - x_before[i];
    d.Ap[i] = r_before[i] - r[i];
    cycle_gain += 0.5 * d.p[i] * (r_before[i] + r[i]);
    for (int k = 0; k < known_; ++k) beta[k] += d.p[i] * older[k]->Ap[i];
  }
  for (int k = 0; k < known_; ++k) beta[k] /= older[k]->energy;
  double force = 0;
  d.energy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < known_; ++k) {
      d.p[i] -= beta[k] * older[k]->p[i];
      d.Ap[i] -= beta[k] * older[k]->Ap[i];
    }
    force += d.p[i] * r_before[i];
    d.energy += d.p[i] * d.Ap[i];
  }
  const double step = force / d.energy;
  if (!(d.energy > 0) || !(0.5 * step * force >= cycle_gain) || !admissible(x_before, d, step)) {
    reset();
    return false;
  }
  for (std::size_t i = 0; i < n; ++i) trial[i] = x_before[i] + step * d.p[i];
  known_ = known_ < depth ? known_ + 1 : depth;
  next_ = (next_ + 1) % (depth + 1);
  return true;
}

template <int B>
bool Recombination<B>::admissible(const std::vector<double>& x_before, const Direction& direction, double step) const {
  for (std::size_t slot = 0; slot < constraints_.vector.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{constraints_.vector[slot]} * B + k;
      const double x = x_before[i] + step * direction.p[i];
      if (!(x >= constraints_.lower[slot * B + k] && x <= constraints_.upper[slot * B + k])) return false;
    }
  return true;
}

template class Recombination<1>;
template class Recombination<2>;
template class Recombination<3>;

}  // namespace signorini
