#include "core/fem/incompressible/pressure_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/dot.hpp"
#include "core/base/rounding.hpp"
#include "core/sdk/block.hpp"
#include "core/solver/jumps.hpp"
#include "core/solver/local_coordinates.hpp"

namespace signorini {
namespace {

constexpr int chebyshev_steps = 6;             // which leave a hundredth of the error
constexpr double least_response = 1e-2;        // part of what an unknown has that nothing is prescribed near
constexpr double nothing = rounding_of_bases;  // part of a load that is rounding

/// Row k of a mass matrix times v.
template <int D>
double product(const PressureSpace<D>& space, const std::vector<double>& entries, Index k,
               const std::vector<double>& v) {
  double sum = 0;
  for (Offset at = space.mass_row[k]; at < space.mass_row[k + 1]; ++at) sum += entries[at] * v[space.mass_column[at]];
  return sum;
}

/// M^-1 g, by conjugate gradients with the diagonal. Its eigenvalues are within a factor of ten or so, see solve().
template <int D>
std::vector<double> solve_mass(const PressureSpace<D>& space, const std::vector<double>& g) {
  constexpr int most_steps = 200;
  std::vector<double> diagonal(g.size()), x(g.size()), r = g, z(g.size()), Md(g.size());
  for (Index k = 0; k < space.size; ++k)
    for (Offset at = space.mass_row[k]; at < space.mass_row[k + 1]; ++at)
      if (space.mass_column[at] == k) diagonal[k] = space.compliance[at];
  const auto precondition = [&] {
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = r[k] / diagonal[k];
    return dot(r, z);
  };
  double rho = precondition();
  const double enough = nothing * nothing * rho;
  std::vector<double> d = z;
  for (int step = 0; step < most_steps && rho > enough; ++step) {
    for (Index k = 0; k < space.size; ++k) Md[k] = product(space, space.compliance, k, d);
    const double length = rho / dot(d, Md), before = rho;
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] += length * d[k];
      r[k] -= length * Md[k];
    }
    rho = precondition();
    for (std::size_t k = 0; k < d.size(); ++k) d[k] = z[k] + rho / before * d[k];
  }
  return x;
}

}  // namespace

template <int D>
PressureLoad<D>::PressureLoad(const PressureSpace<D>& space, Discretization<D>& discretization, std::vector<double> p,
                              std::vector<double> thermal_volume)
    : space_(space),
      discretization_(discretization),
      p_(std::move(p)),
      thermal_volume_(std::move(thermal_volume)),
      value_(space.value) {
  p_.resize(static_cast<std::size_t>(space.size));
  for (std::size_t at = 0; !problem().jumps && at < space.column.size(); ++at)
    if (const double* Q = problem().frames.at(space.column[at])) {
      double local[D];
      block::transposed_product<D>(Q, value_.data() + at * D, local);
      std::copy_n(local, D, value_.data() + at * D);
    }
  find_schur();
  find_shut_in();
  if (!thermal_volume_.empty()) find_thermal_sizes();
}

template <int D>
void PressureLoad<D>::find_thermal_sizes() {
  std::vector<double> held(p_.size());
  step_.resize(p_.size());
  solve(thermal_volume_, held);
  thermal_size_ = max_norm(held);
  thermal_energy_ = 0.5 * dot(thermal_volume_, solve_mass(space_, thermal_volume_));
}

// Near prescribed components less of the displacements responds: in the corners of a body that is held all around next
// to nothing. What stands for the response is scaled by the part of C that is free, up to a half, which flat sides
// have.
template <int D>
void PressureLoad<D>::find_schur() {
  std::vector<double> factor(p_.size());
  for (Index k = 0; k < space_.size; ++k) {
    double all = 0, free = 0;
    for (Offset at = space_.row[k]; at < space_.row[k + 1]; ++at)
      for (int i = 0; i < D; ++i) {
        const double square = value_[at * D + i] * value_[at * D + i];
        all += square;
        if (!(problem().fixed[space_.column[at]] >> i & 1u)) free += square;
      }
    factor[k] = std::pow(std::clamp(2 * free / all, least_response, 1.0), 0.75);
  }
  schur_ = space_.compliance;
  inverse_.resize(p_.size());
  for (Index k = 0; k < space_.size; ++k)
    for (Offset at = space_.mass_row[k]; at < space_.mass_row[k + 1]; ++at) {
      schur_[at] += factor[k] * factor[space_.mass_column[at]] * space_.response[at];
      if (space_.mass_column[at] == k) inverse_[k] = 1 / schur_[at];
    }
}

/// 1 in a material, or in all: -1.
template <int D>
std::vector<double> PressureLoad<D>::constant_in(Index material) const {
  std::vector<double> out(p_.size());
  for (Index k = 0; k < space_.size; ++k) out[k] = material < 0 || space_.material[k] == material ? 1 : 0;
  return out;
}

// Nothing but compression resists a constant pressure in what is held all around.
template <int D>
void PressureLoad<D>::find_shut_in() {
  for (Index material = space_.materials > 1 ? -1 : 0; material < space_.materials; ++material) {
    std::vector<double> one = constant_in(material);
    double all = 0, free = 0;
    const std::vector<double>& load = load_of(one);
    for (std::size_t at = 0; at < load.size(); ++at) {
      all += load[at] * load[at];
      if (!(problem().fixed[at / D] >> (at % D) & 1u)) free += load[at] * load[at];
    }
    if (free > nothing * nothing * all) continue;
    double own = 0, resistance = 0;
    for (Index k = 0; k < space_.size; ++k) {
      own += one[k] * product(space_, space_.compliance, k, one);
      resistance += one[k] * product(space_, schur_, k, one);
    }
    shut_in_.push_back({std::move(one), 1 / own - 1 / resistance});
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

/// b and the work, that along thermal strains too (where all is held it is zero), from what they are without it: what
/// large p were in between leaves no rounding. Where components are prescribed what they lose in work counts.
template <int D>
void PressureLoad<D>::renew_load() {
  DiscreteProblem<D>& to = problem();
  const std::vector<double>& load = load_of(p_);
  to.prescribed_work = own_work_ + thermal_energy_;
  for (std::size_t k = 0; k < thermal_volume_.size(); ++k) to.prescribed_work += p_[k] * thermal_volume_[k];
  for (std::size_t p = 0; p < to.fixed.size(); ++p)
    for (std::size_t k = 0; k < D; ++k) {
      const std::size_t at = p * D + k;
      if (to.fixed[p] >> k & 1u)
        to.prescribed_work -= load[at] * to.start[at];
      else
        to.b[at] = own_[at] - load[at];
    }
}

template <int D>
void PressureLoad<D>::apply() {
  if (std::exchange(applied_, true)) return;
  own_ = problem().b;
  own_work_ = problem().prescribed_work;
  renew_load();
}

template <int D>
void PressureLoad<D>::withdraw() {
  if (!std::exchange(applied_, false)) return;
  problem().b = own_;
  problem().prescribed_work = own_work_;
}

template <int D>
void PressureLoad<D>::set(std::vector<double> values) {
  withdraw();
  p_ = std::move(values);
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
    if (!thermal_volume_.empty()) sum -= thermal_volume_[k];
    for (Offset at = space_.row[k]; at < space_.row[k + 1]; ++at)
      for (int i = 0; i < D; ++i) sum += value_[at * D + i] * u[Offset{space_.column[at]} * D + i];
    residual[k] = sum;
  }
  solve(residual, change);
  for (const ShutIn& body : shut_in_) {
    const double along = dot(body.pressure, residual);
    for (std::size_t k = 0; k < change.size(); ++k) change[k] += body.more * along * body.pressure[k];
  }
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
    for (Index k = 0; k < space_.size; ++k) remaining_[k] -= product(space_, schur_, k, step_);
    const double next = 1 / (2 * middle / half - rho);
    for (std::size_t k = 0; k < p_.size(); ++k)
      step_[k] = next * (rho * step_[k] + 2 / half * inverse_[k] * remaining_[k]);
    rho = next;
    for (std::size_t k = 0; k < p_.size(); ++k) change[k] += step_[k];
  }
}

template <int D>
void PressureLoad<D>::add(const std::vector<double>& change, std::vector<double>& r) {
  for (std::size_t k = 0; k < p_.size(); ++k) p_[k] += change[k];
  const std::vector<double>& b = problem().b;
  for (std::size_t at = 0; at < r.size(); ++at) r[at] -= b[at];
  renew_load();
  for (std::size_t at = 0; at < r.size(); ++at) r[at] += b[at];
}

template <int D>
typename FollowingLoad<D>::Matrices PressureLoad<D>::matrices() const {
  typename FollowingLoad<D>::Matrices out;
  const DiscreteProblem<D>& of = discretization_.problem;
  for (Index k = 0; k < space_.size; ++k) {
    VectorRow<D> c;
    for (Offset at = space_.row[k]; at < space_.row[k + 1]; ++at)
      std::copy_n(value_.data() + at * D, D, c[space_.column[at]].begin());
    if (of.jumps) transform_row<D>(*of.jumps, c);
    for (const auto& [p, value] : c) {
      std::array<double, D> local = value;
      if (const double* Q = of.jumps ? of.frames.at(p) : nullptr)
        block::transposed_product<D>(Q, value.data(), local.data());
      out.column.push_back(p);
      for (int i = 0; i < D; ++i) out.value.push_back(of.fixed[p] >> i & 1u ? 0 : local[i]);
    }
    out.row.push_back(std::ssize(out.column));
  }
  out.mass_row = space_.mass_row;
  out.mass_column = space_.mass_column;
  out.mass = space_.compliance;
  return out;
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
