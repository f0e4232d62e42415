#include "core/fem/pressure_load.hpp"

#include <algorithm>
#include <utility>

#include "core/base/dot.hpp"
#include "core/sdk/block.hpp"
#include "core/solver/local_coordinates.hpp"

namespace signorini {
namespace {

constexpr int chebyshev_steps = 6;  // which leave a hundredth of the error

/// Row k of a mass matrix times v.
template <int D>
double product(const PressureSpace<D>& space, const std::vector<double>& entries, Index k,
               const std::vector<double>& v) {
  double sum = 0;
  for (Offset at = space.mass_row[k]; at < space.mass_row[k + 1]; ++at) sum += entries[at] * v[space.mass_column[at]];
  return sum;
}

}  // namespace

template <int D>
PressureLoad<D>::PressureLoad(const PressureSpace<D>& space, Discretization<D>& discretization, std::vector<double> p)
    : space_(space), discretization_(discretization), p_(std::move(p)), value_(space.value) {
  p_.resize(static_cast<std::size_t>(space.size));
  for (std::size_t at = 0; !problem().jumps && at < space.column.size(); ++at)
    if (const double* Q = problem().frames.at(space.column[at])) {
      double local[D];
      block::transposed_product<D>(Q, value_.data() + at * D, local);
      std::copy_n(local, D, value_.data() + at * D);
    }
  inverse_.resize(p_.size());
  for (Index k = 0; k < space.size; ++k)
    for (Offset at = space.mass_row[k]; at < space.mass_row[k + 1]; ++at)
      if (space.mass_column[at] == k) inverse_[k] = 1 / space.schur[at];
  for (auto* of_material : {&along_, &own_, &resistance_, &more_})
    of_material->assign(static_cast<std::size_t>(space.materials), 0);
  for (Index k = 0; k < space.size; ++k)
    for (Offset at = space.mass_row[k]; at < space.mass_row[k + 1]; ++at) {
      if (space.material[space.mass_column[at]] != space.material[k]) continue;
      own_[space.material[k]] += space.compliance[at];
      resistance_[space.material[k]] += space.schur[at];
    }
}

template <int D>
const std::vector<double>& PressureLoad<D>::load_of(const std::vector<double>& p) {
  load_.assign(problem().b.size(), 0);
  for (Index k = 0; k < space_.size; ++k)
    for (Offset at = space_.row[k]; at < space_.row[k + 1]; ++at)
      for (int i = 0; i < D; ++i) load_[Offset{space_.column[at]} * D + i] += p[k] * value_[at * D + i];
  if (problem().jumps) load_ = local_forces(problem(), std::move(load_));
  return load_;
}

/// What value_ is to be multiplied with.
template <int D>
const std::vector<double>& PressureLoad<D>::displacements(const std::vector<double>& x) {
  if (!problem().jumps) return x;
  displacements_ = to_global(problem(), x);
  return displacements_;
}

template <int D>
std::vector<double> PressureLoad<D>::load_along(std::size_t e) {
  std::vector<double> one(p_.size());
  for (std::size_t k = 0; k < one.size(); ++k) one[k] = static_cast<std::size_t>(space_.material[k]) == e ? 1 : 0;
  std::vector<double> out = load_of(one);
  for (std::size_t at = 0; at < out.size(); ++at)
    if (problem().fixed[at / D] >> (at % D) & 1u) out[at] = 0;
  return out;
}

template <int D>
void PressureLoad<D>::set_resistance(std::size_t e, double resistance) {
  more_[e] = resistance > 0 ? 1 / resistance - 1 / resistance_[e] : 0;
}

/// From b where components are free. What the prescribed ones lose in work counts, too.
template <int D>
void PressureLoad<D>::subtract(const std::vector<double>& load) {
  DiscreteProblem<D>& to = problem();
  for (std::size_t p = 0; p < to.fixed.size(); ++p)
    for (std::size_t k = 0; k < D; ++k) {
      const std::size_t at = p * D + k;
      if (to.fixed[p] >> k & 1u)
        to.prescribed_work -= load[at] * to.start[at];
      else
        to.b[at] -= load[at];
    }
}

template <int D>
void PressureLoad<D>::apply() {
  subtract(load_of(p_));
}

template <int D>
void PressureLoad<D>::correct(const std::vector<double>& x, std::vector<double>& change,
                              std::vector<double>& residual) {
  residual.resize(p_.size());
  change.resize(p_.size());
  step_.resize(p_.size());
  const std::vector<double>& u = displacements(x);
  for (Index k = 0; k < space_.size; ++k) {
    double sum = -product(space_, space_.compliance, k, p_);
    for (Offset at = space_.row[k]; at < space_.row[k + 1]; ++at)
      for (int i = 0; i < D; ++i) sum += value_[at * D + i] * u[Offset{space_.column[at]} * D + i];
    residual[k] = sum;
  }
  solve(residual, change);
  std::fill(along_.begin(), along_.end(), 0.0);
  for (Index k = 0; k < space_.size; ++k) along_[space_.material[k]] += residual[k];
  for (Index k = 0; k < space_.size; ++k) change[k] += more_[space_.material[k]] * along_[space_.material[k]];
}

// Chebyshev's iteration from zero, with the diagonal. That bounds the eigenvalues of mass matrices (Wathen, IMA J.
// Numer. Anal. 7, 1987): linear functions have them from 1/2 to (D + 2) / 2.
template <int D>
void PressureLoad<D>::solve(const std::vector<double>& residual, std::vector<double>& change) {
  const bool diagonal = space_.kind == Pressure::constant;
  const double least = diagonal ? 1 : 0.5, largest = diagonal ? 1 : (D + 2) / 2.0;
  const double middle = (least + largest) / 2, half = (largest - least) / 2;
  for (std::size_t k = 0; k < p_.size(); ++k) change[k] = step_[k] = inverse_[k] * residual[k] / middle;
  if (diagonal) return;
  remaining_ = residual;
  double rho = half / middle;
  for (int s = 1; s < chebyshev_steps; ++s) {
    for (Index k = 0; k < space_.size; ++k) remaining_[k] -= product(space_, space_.schur, k, step_);
    const double next = 1 / (2 * middle / half - rho);
    for (std::size_t k = 0; k < p_.size(); ++k)
      step_[k] = next * (rho * step_[k] + 2 / half * inverse_[k] * remaining_[k]);
    rho = next;
    for (std::size_t k = 0; k < p_.size(); ++k) change[k] += step_[k];
  }
}

template <int D>
void PressureLoad<D>::add(const std::vector<double>& change, std::vector<double>& r) {
  const std::vector<double>& load = load_of(change);
  for (std::size_t k = 0; k < p_.size(); ++k) p_[k] += change[k];
  subtract(load);
  for (std::size_t at = 0; at < r.size(); ++at)
    if (!(problem().fixed[at / D] >> (at % D) & 1u)) r[at] -= load[at];
}

template <int D>
double PressureLoad<D>::squared() const {
  double sum = 0;
  for (Index k = 0; k < space_.size; ++k) sum += p_[k] * product(space_, space_.compliance, k, p_);
  return sum;
}

template <int D>
void PressureLoad<D>::press_on_prescribed() {
  PrescribedRows<D>& rows = discretization_.prescribed;
  const std::vector<double>& load = load_of(p_);
  for (std::size_t k = 0; k < rows.vertex.size(); ++k)
    for (int i = 0; i < D; ++i) rows.load[k * D + i] -= load[Offset{rows.vertex[k]} * D + i];
}

template class PressureLoad<2>;
template class PressureLoad<3>;

}  // namespace signorini
