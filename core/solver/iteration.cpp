#include "core/solver/iteration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/algebra/careful_residual.hpp"
#include "core/algebra/products.hpp"
#include "core/base/clock.hpp"
#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/attainable.hpp"
#include "core/solver/following_load.hpp"
#include "core/solver/functional.hpp"

namespace signorini {

namespace {

constexpr double of_products = 32;  // rounding of a row of a product, in units of what it is of the largest unknown
constexpr double risen = 1e-4;      // error of the size that rounding may have without it having carried x away
constexpr double negligible = 0.3;  // of the tolerance: bounds of rounding that need no closer look
constexpr double attained = 10;     // errors up to so many times what rounding does are as small as it lets them be
constexpr double far_off =
    100;  // residual over the tolerance up to which rounding may be what is left beside functionals
constexpr double small_residual = 1e-3;  // that rounding may leave

}  // namespace

template <int B>
Summary Iteration<B>::run(const Monitor& monitor, int before) {
  const double begin = seconds();
  before_ = before;
  summary_.level_unknowns = unknowns();
  for (Index p = 0; p < problem_.A.size(); ++p)
    for (int k = 0; k < B; ++k) trace_ += problem_.A.diagonal(p)[k * B + k];
  largest_before_ = max_norm(problem_.constraints.last);
  if (problem_.following) problem_.following->withdraw();
  reference_ = residual_at_projected_zero();
  if (problem_.following) problem_.following->apply();
  make_admissible(problem_, x_);
  x_before_ = x_;
  sums_ = evaluate(x_, r_);
  refuse_nan(sums_.natural_residual);
  while (!step(monitor)) {
  }
  summary_.find_linear_phase();
  finish_energies();
  summary_.options = options_;
  summary_.options.method = method();
  finish_stage(begin);
  return std::move(summary_);
}

template <int B>
bool Iteration<B>::step(const Monitor& monitor) {
  r_before_.swap(r_);
  Step step = advance();
  const bool bounded = step.bounded, gaining = step.gaining, exact = step.exact;
  const std::string stuck = step.stuck;
  measure(step.error);
  if (step.carried && within_tolerance()) {  // claimed for a residual that was not computed from the iterate alone
    sums_ = evaluate(x_, r_);
    measure(step.error);
  }
  record(std::move(step));
  const bool go_on = !monitor || monitor(summary_.history.back());
  if (finished(gaining, exact)) return true;
  if (!bounded && !rests_at_rounding())
    return end(Outcome::unbounded, "the energy is unbounded below: nothing holds the body against the loads");
  if (!go_on)
    return end(
        Outcome::interrupted,
        fmt::format("interrupted after {} iterations: residual {:.3e}, algebraic error {:.3e}, tolerance {:.3e}",
                    before_ + summary_.iterations, summary_.residual, summary_.algebraic_error, options_.tolerance));
  if (!stuck.empty()) return end(Outcome::stuck, stuck);
  if (before_ + summary_.iterations >= options_.max_iterations)
    return end(Outcome::iteration_limit,
               fmt::format("iteration limit {}: residual {:.3e}, algebraic error {:.3e}, tolerance {:.3e}",
                           options_.max_iterations, summary_.residual, summary_.algebraic_error, options_.tolerance));
  return false;
}

template <int B>
typename Iteration<B>::Sums Iteration<B>::evaluate(std::vector<double>& x, std::vector<double>& r) {
  Sums sums;
  evaluate(x, r, 0, problem_.A.size(), sums);
  return sums;
}

template <int B>
void Iteration<B>::evaluate(std::vector<double>& x, std::vector<double>& r, Index first, Index last, Sums& sums) {
  in_pieces<B>(first, last, [&](Index from, Index to) {
    double* own = r.data() + Offset{from} * B;
    if (!careful_) residual<B>(problem_.A, x.data(), problem_.b.data(), from, to, own);
    if constexpr (B == 1)
      if (careful_) careful_residual(problem_.A, x.data(), problem_.b.data(), from, to, own);
    add_sums(x, r, from, to, sums);
  });
}

template <int B>
void Iteration<B>::add_sums(std::vector<double>& x, const std::vector<double>& r, Index first, Index last, Sums& sums) {
  const double added = functional::change(finest(), x_before_.data(), x.data(), first, last);
  if (follows()) functional::renew(finest(), x.data(), r.data(), first, last, data_.data());
  add_natural_residual(x, first, last, r, sums.natural_residual);
  // J(before) - J(x) = d'(r_before + r) / 2 and ||d||_A^2 = d'(r_before - r): no cancellation of energies.
  double gain = 0, correction = 0, size = 0, largest = sums.largest, moved = sums.moved;
  const double *before = x_before_.data(), *r_before = r_before_.data(), *now = x.data(), *r_now = r.data();
#pragma omp simd reduction(+ : gain, correction, size) reduction(max : largest, moved)
  for (Offset i = Offset{first} * B; i < Offset{last} * B; ++i) {
    const double d = now[i] - before[i];
    gain += 0.5 * d * (r_before[i] + r_now[i]);
    correction += d * (r_before[i] - r_now[i]);
    size += std::abs(d * r_before[i]) + std::abs(d * r_now[i]);
    largest = std::max(largest, std::abs(now[i]));
    moved = std::max(moved, std::abs(d));
  }
  sums.gain += gain - added;
  sums.correction += correction;
  sums.size += size;
  sums.largest = largest;
  sums.moved = moved;
  sums.products += free_products(problem_, x, r, first, last);
  if (!finest().constraints.facet.empty()) leave_out_facets(x, r, first, last, sums);
}

// Facets are met up to rounding, and large forces do work along that: what has stayed on them counts as if it had been
// there exactly. That work is taken out of the sums; a start that is moved onto them would be rounded itself.
template <int B>
void Iteration<B>::leave_out_facets(const std::vector<double>& x, const std::vector<double>& r, Index first, Index last,
                                    Sums& sums) {
  const Level<B>& level = finest();
  const Constraints<B>& c = level.constraints;
  across_.resize(x.size());
  const auto [from, to] = slots_between(c, first, last);
  for (Index slot = from; slot < to; ++slot) {
    if (!c.has_facets(slot)) continue;
    const Offset at = Offset{c.vector[slot]} * B;
    double P[B * B], d[B], along[B];
    Flags resting = 0;
    for (int k = 0; k < B; ++k) {
      d[k] = x[at + k] - x_before_[at + k];
      resting |= static_cast<Flags>((d[k] == 0) << k);
    }
    c.polyhedron(slot).hold(x.data() + at, x_before_.data() + at, resting, P);
    block::product<B>(P, d, along);
    for (int k = 0; k < B; ++k) {
      const double across = across_[at + k] = d[k] - along[k];
      sums.gain -= 0.5 * across * (r_before_[at + k] + r[at + k]);
      sums.correction -= across * (r_before_[at + k] - r[at + k]);
    }
  }
  if (level.nonlinear) sums.gain += functional::slope(level, x.data(), across_.data(), first, last);
}

template <int B>
void Iteration<B>::add_natural_residual(std::vector<double>& x, Index first, Index last, const std::vector<double>& r,
                                        double& largest) const {
  const Level<B>& level = finest();
  LevelView<B> view = level.view();
  view.x = x.data();
  if (follows()) view.data = data_.data();
  level.for_each_segment(first, last, Order::forward, [&](const Segment<B>& s, Index begin, Index end) {
    largest = block::larger(largest, s.obstacle->natural_residual(view, begin, end, r.data()));
  });
}

template <int B>
void Iteration<B>::measure(double error) {
  Summary& s = summary_;
  const double of_load = problem_.following ? problem_.following->squared() : 0;
  double squared = energy_norm_squared(problem_, x_, sums_.products) + of_load;
  const double rounding = squared <= trace_ * sums_.largest * sums_.largest * rounding_of_sums ? rounding_energy() : 0;
  moves_rigidly_ = squared < rounding;
  // Of what only moves such a load is rounding, which changes by all that it is.
  s.residual = moves_rigidly_ ? relative_residual() : std::max(relative_residual(), residual_of_load_);
  size_ = std::sqrt(std::max(squared, rounding));
  // Back at zero after a load step, but for rounding of positions: nothing is left that errors could be compared with.
  const bool at_zero = zero_solves_ && largest_before_ > 0 && is_rounding_of_unknowns();
  s.algebraic_error = error == 0 || at_zero ? 0 : size_ > 0 ? error / size_ : 1;
  s.energy = energy(problem_, sums_.products) - 0.5 * of_load;
  if (finest().nonlinear) {
    zero_.resize(x_.size());
    s.energy +=
        functional::change(finest(), zero_.data(), x_.data(), 0, problem_.A.size(), follows() ? data_.data() : nullptr);
  }
}

template <int B>
void Iteration<B>::record(Step step) {
  Summary& s = summary_;
  ++s.iterations;
  s.rate = step.rate;
  gains_.push_back(sums_.gain);
  const Index contact = step.levels.back().critical, changed = step.levels.back().changed;
  s.history.push_back(
      {before_ + s.iterations, s.residual, s.algebraic_error, s.energy, contact, changed, std::move(step.levels)});
}

// What rounding leaves of x'Ax for a rigid motion, which has no energy.
template <int B>
double Iteration<B>::rounding_energy() const {
  return careful_ ? storage_energy() : 16 * std::numeric_limits<double>::epsilon() * energy_of_diagonal();
}

template <int B>
double Iteration<B>::storage_energy() const {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  return epsilon * epsilon * energy_of_diagonal();
}

// x'Dx on the free components, D the diagonal of A.
template <int B>
double Iteration<B>::energy_of_diagonal() const {
  double sum = 0;
  for (Index p = 0; p < problem_.A.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (const double v = x_[Offset{p} * B + k]; !(problem_.fixed[p] >> k & 1u))
        sum += problem_.A.diagonal(p)[k * B + k] * v * v;
  return sum;
}

template <int B>
bool Iteration<B>::within_tolerance() const {
  return summary_.residual <= options_.tolerance && summary_.algebraic_error <= options_.tolerance;
}

// Solved: to the tolerance, with what rounding does counted in, or as far as that allows.
template <int B>
bool Iteration<B>::finished(bool gaining, bool exact) {
  Summary& s = summary_;
  stalled_ = sums_.natural_residual > 0.5 * least_ ? stalled_ + 1 : 0;
  least_ = std::min(least_, sums_.natural_residual);
  // A rigid motion has no energy that errors could be compared with: forces are, with those that act.
  std::optional<double> hidden;
  if (moves_rigidly_ && !gaining && s.residual <= options_.tolerance) {
    if (problem_.following) problem_.following->withdraw();  // it is rounding, too, and no load to compare with
    const Balance forces = balance(problem_, x_, r_);
    if (problem_.following) problem_.following->apply();
    const bool any = forces.acting > 0;
    s.algebraic_error = s.history.back().algebraic_error = any ? forces.resting / forces.acting : 0;
    hidden = any ? forces.rounding / forces.acting : 0;
  }
  // What friction hardly fails to hold slides so far that forces drown in rounding, and a load that follows the
  // solution may carry it away: small errors beside that say nothing.
  const bool runs_away = (finest().nonlinear || problem_.following) && s.residual > far_off * options_.tolerance;
  const bool rounding_alone = !runs_away && (is_rounding_of_unknowns() || (exact && s.residual <= small_residual));
  const bool at_rest = stalled_ >= 3 && !gaining && rounding_alone && !has_risen();
  if (!within_tolerance() && !at_rest) return false;
  double of_rounding = hidden ? *hidden : size_ > 0 ? rounding_error() / size_ : 0;
  if (exact && !within_tolerance()) of_rounding = std::max(of_rounding, s.algebraic_error);
  const double error = std::hypot(s.algebraic_error, of_rounding);
  // Large residuals beside larger unknowns, as of slender bodies: it takes the error by rounding to explain them.
  if (of_rounding == 0 && !within_tolerance() && !rests_at_rounding() && !exact) return false;
  if (error > std::max(options_.tolerance, attained * of_rounding)) return false;
  s.rounding_error = of_rounding;
  s.algebraic_error = s.history.back().algebraic_error = error;
  if (within_tolerance())
    return end(Outcome::converged, fmt::format("residual {:.3e} and algebraic error {:.3e} are at most {:.3e}",
                                               s.residual, s.algebraic_error, options_.tolerance));
  if (of_rounding > inaccurate)
    return end(Outcome::inaccurate,
               fmt::format("rounding leaves an algebraic error of about {:.1e}, tolerance {:.3e}: the matrix is too "
                           "badly conditioned for the machine's precision",
                           of_rounding, options_.tolerance));
  return end(Outcome::rounding, fmt::format("limited by rounding: residual {:.3e} and algebraic error {:.3e} reached, "
                                            "tolerance {:.3e}",
                                            s.residual, s.algebraic_error, options_.tolerance));
}

// Found once: near the solution it changes no more.
template <int B>
double Iteration<B>::rounding_error() {
  const double enough = negligible * options_.tolerance * size_;
  if (careful_) {
    const double stored = std::sqrt(storage_energy());
    return stored <= enough ? 0 : stored;
  }
  if (rounding_error_) return *rounding_error_;
  const double rough = rough_rounding_error(problem_, x_, x_before_, sums_.products.xAx, sums_.correction);
  rounding_error_ = rough <= enough
                        ? 0
                        : signorini::rounding_error<B>(problem_, x_, enough,
                                                       [this](const std::vector<double>& forces, double enough_) {
                                                         return response(forces, enough_);
                                                       });
  return *rounding_error_;
}

template <int B>
bool Iteration<B>::is_rounding_of_unknowns() const {
  const double size = std::max(sums_.largest, largest_before_);
  return sums_.natural_residual <= 1000 * std::numeric_limits<double>::epsilon() * size;
}

template <int B>
double Iteration<B>::relative_residual() const {
  return reference_ > 0 ? sums_.natural_residual / reference_ : is_rounding_of_unknowns() ? 0 : infinity;
}

// Unless it is the iteration that carried the unknowns away.
template <int B>
bool Iteration<B>::rests_at_rounding() const {
  return is_rounding_of_unknowns() && summary_.residual <= small_residual;
}

// Whether the energy is above that of the start, by more than an error of the size that rounding may have: then the
// iteration has carried the unknowns away, whatever their residual says.
template <int B>
bool Iteration<B>::has_risen() const {
  const double gain = std::accumulate(gains_.begin(), gains_.end(), 0.0);
  return !(gain >= -0.5 * risen * risen * energy_norm_squared(problem_, x_, sums_.products));
}

template <int B>
bool Iteration<B>::end(Outcome outcome, std::string reason) {
  summary_.outcome = outcome;
  summary_.reason = std::move(reason);
  return true;
}

// The energies themselves are differences of what may be far larger, the gains are not. Where functionals follow the
// solution gains belong to energies of their own, and do not add up.
template <int B>
void Iteration<B>::finish_energies() {
  if (follows() || problem_.following) return;
  auto& history = summary_.history;
  for (std::size_t k = history.size(); k-- > 1;) history[k - 1].energy = history[k].energy + gains_[k];
}

template <int B>
void Iteration<B>::finish_stage(double begin) {
  Stage stage;
  stage.method = method();
  stage.iterations = summary_.iterations;
  stage.seconds = seconds() - begin;
  stage.outcome = summary_.outcome;
  stage.reason = summary_.reason;
  add_work(stage);
  summary_.stages = {std::move(stage)};
}

// Where it is rounding the projected zero is the solution, and no other start has a scale to be measured by. After a
// load step friction that follows the solution may hold what presses, whatever is taken off: then the forces of the
// start are the scale, and zero is one solution of several.
template <int B>
double Iteration<B>::residual_at_projected_zero() {
  make_admissible(problem_, x_before_);
  const Sums sums = evaluate(x_before_, r_);
  const double size = std::max(sums.largest, largest_before_);
  zero_solves_ = !(sums.natural_residual > of_products * std::numeric_limits<double>::epsilon() * size);
  double held = 0;
  if (follows() && largest_before_ > 0) {
    make_admissible(problem_, x_);
    evaluate(x_, r_);
    held = displacement_by_forces(r_);
  }
  if (held > of_products * std::numeric_limits<double>::epsilon() * size) return std::max(held, sums.natural_residual);
  if (!zero_solves_) return sums.natural_residual;
  x_ = x_before_;
  return 0;
}

// The largest displacement by what is left of forces at one vector, were it to move alone and free.
template <int B>
double Iteration<B>::displacement_by_forces(const std::vector<double>& r) const {
  double largest = 0;
  for (Index p = 0; p < problem_.A.size(); ++p) {
    double d[B];
    block::product<B>(finest().inverse.data() + Offset{p} * B * B, r.data() + Offset{p} * B, d);
    largest = block::larger(largest, block::norm<B>(d));
  }
  return largest;
}

template <int B>
Index Iteration<B>::free_unknowns(const Level<B>& level) const {
  Index free = 0;
  for (const Flags off : level.off)
    for (int k = 0; k < B; ++k) free += !(off >> k & 1u);
  return free;
}

template <int B>
void Iteration<B>::refuse_nan(double residual) {
  if (!std::isfinite(residual))
    throw Error(Exit::input,
                "solver: the residual is not finite; the matrix, the loads or the start hold values that "
                "are infinite, NaN or too large to square");
}

template class Iteration<1>;
template class Iteration<2>;
template class Iteration<3>;

}  // namespace signorini
