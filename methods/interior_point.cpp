#include "methods/interior_point.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/products.hpp"
#include "core/base/dot.hpp"
#include "core/solver/multigrid.hpp"

namespace signorini {

namespace {

constexpr double to_the_boundary = 0.995;  // part of the longest step that keeps distances and multipliers positive
constexpr double shift = 1e-8;             // of the diagonal, for what no bound holds
constexpr int patience = 10;               // steps without an error less than this part of the least one
constexpr double less = 0.9;
constexpr double inside = 0.1;  // of the way between two bounds, or of the size of x: first distances

}  // namespace

template <int B>
InteriorPointIteration<B>::InteriorPointIteration(const DiscreteProblem<B>& problem, std::vector<double>& x,
                                                  const SolverOptions& options, const Registry& registry,
                                                  const std::string& linear)
    : Iteration<B>(problem, x, options),
      linear_(linear),
      level_(finest_level(problem)),
      system_(problem.A, registry.create<LinearSolver>("linear", linear)),
      held_(x.size(), 0),
      added_(x.size()) {}

template <int B>
void InteriorPointIteration<B>::collect_sides() {
  const Constraints<B>& c = level_.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Index p = c.vector[slot];
      const Offset i = Offset{p} * B + k, at = Offset{slot} * B + k;
      if (level_.off[p] >> k & 1u) continue;
      held_[i] = c.lower[at] == c.upper[at];
      if (held_[i]) continue;
      if (c.lower[at] > -infinity) sides_.push_back({.i = i, .sign = 1, .value = c.lower[at]});
      if (c.upper[at] < infinity) sides_.push_back({.i = i, .sign = -1, .value = c.upper[at]});
    }
}

// From an admissible vector into the interior; multipliers that balance the forces where they can.
template <int B>
void InteriorPointIteration<B>::start() {
  collect_sides();
  y_ = this->x_;
  d_.resize(y_.size());
  force_.resize(y_.size());
  double size = 0;
  for (std::size_t i = 0; i < y_.size(); ++i)
    size = std::max({size, std::abs(y_[i]), std::abs(this->r_before_[i]) / system_.diagonal(static_cast<Offset>(i))});
  if (size == 0) size = 1;  // the start is the solution
  const Constraints<B>& c = level_.constraints;
  for (Side& s : sides_) {
    const Offset at = Offset{c.slot[s.i / B]} * B + s.i % B;
    const double lower = c.lower[at], upper = c.upper[at], margin = inside * std::min(upper - lower, size);
    y_[s.i] = block::clamp(y_[s.i], lower + margin, upper - margin);
  }
  residual<B>(*level_.A, y_.data(), this->problem_.b.data(), force_.data());
  for (Side& s : sides_) {
    s.distance = s.sign * (y_[s.i] - s.value);
    s.multiplier = std::max(-s.sign * force_[s.i], 0.0) + system_.diagonal(s.i) * inside * size;
  }
}

template <int B>
typename InteriorPointIteration<B>::Step InteriorPointIteration<B>::advance() {
  if (!std::exchange(started_, true)) start();
  this->x_before_ = this->x_;
  Step step;
  if (!predict_and_correct()) step.stuck = "the matrix with the multipliers is not positive definite";
  put_onto_bounds();
  this->sums_ = this->evaluate(this->x_, this->r_);
  this->refuse_nan(this->sums_.natural_residual);
  const double last_gain = std::sqrt(2 * std::abs(this->sums_.gain));  // what falls for ever has no gap
  step.error = this->sums_.natural_residual == 0 ? 0 : std::max(error_bound(), last_gain);
  if (step.stuck.empty() && !progresses(step.error)) step.stuck = "the interior points make no progress";
  step.levels = {report()};
  return step;
}

template <int B>
bool InteriorPointIteration<B>::progresses(double error) {
  idle_ = error < less * least_error_ ? 0 : idle_ + 1;
  least_error_ = std::min(least_error_, error);
  return idle_ < patience;
}

template <int B>
LevelReport InteriorPointIteration<B>::report() const {
  LevelReport out;
  out.vectors = level_.vectors;
  const Constraints<B>& c = level_.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) {
    bool critical = false;
    for (int k = 0; k < B; ++k) {
      const double x = this->x_[Offset{c.vector[slot]} * B + k];
      const bool contact = x <= c.lower[Offset{slot} * B + k] || x >= c.upper[Offset{slot} * B + k];
      out.contact[static_cast<std::size_t>(k)] += contact;
      critical = critical || contact;
    }
    out.critical += critical;
  }
  return out;
}

template <int B>
bool InteriorPointIteration<B>::predict_and_correct() {
  residual<B>(*level_.A, y_.data(), this->problem_.b.data(), force_.data());
  if (!factorise() || !find_direction(0, false)) return false;
  const double now = complementarity(0), after = complementarity(longest_step());
  if (now > 0 && !find_direction(now * std::pow(after / now, 3), true)) return false;
  take(std::min(1.0, to_the_boundary * longest_step()));
  return true;
}

template <int B>
bool InteriorPointIteration<B>::factorise() {
  for (std::size_t i = 0; i < added_.size(); ++i) added_[i] = shift * system_.diagonal(static_cast<Offset>(i));
  for (const Side& s : sides_) added_[s.i] += s.multiplier / s.distance;
  return system_.factorise(held_, added_);
}

// Newton's step for distance * multiplier = complementarity and forces that balance.
template <int B>
bool InteriorPointIteration<B>::find_direction(double complementarity, bool correct) {
  d_ = force_;
  const auto wanted = [&](const Side& s) {
    return complementarity - (correct ? s.distance_step * s.multiplier_step : 0);
  };
  for (Side& s : sides_) d_[s.i] += s.sign * wanted(s) / s.distance;
  for (std::size_t i = 0; i < d_.size(); ++i)
    if (held_[i] || (level_.off[i / B] >> (i % B) & 1u)) d_[i] = 0;
  if (!system_.solve(d_)) return false;
  for (Side& s : sides_) {
    const double aim = wanted(s);
    s.distance_step = s.sign * d_[s.i];
    s.multiplier_step = (aim - s.multiplier * s.distance_step) / s.distance - s.multiplier;
  }
  return true;
}

template <int B>
double InteriorPointIteration<B>::longest_step() const {
  double step = 1 / to_the_boundary;
  for (const Side& s : sides_) {
    if (s.distance_step < 0) step = std::min(step, -s.distance / s.distance_step);
    if (s.multiplier_step < 0) step = std::min(step, -s.multiplier / s.multiplier_step);
  }
  return step;
}

template <int B>
void InteriorPointIteration<B>::take(double step) {
  for (std::size_t i = 0; i < y_.size(); ++i) y_[i] += step * d_[i];
  for (Side& s : sides_) {
    s.distance += step * s.distance_step;
    s.multiplier += step * s.multiplier_step;
  }
}

/// The mean of distance * multiplier after a step.
template <int B>
double InteriorPointIteration<B>::complementarity(double step) const {
  double sum = 0;
  for (const Side& s : sides_) sum += (s.distance + step * s.distance_step) * (s.multiplier + step * s.multiplier_step);
  return sides_.empty() ? 0 : sum / static_cast<double>(sides_.size());
}

template <int B>
void InteriorPointIteration<B>::put_onto_bounds() {
  this->x_ = y_;
  for (const Side& s : sides_)
    if (s.distance * system_.diagonal(s.i) < s.multiplier) this->x_[s.i] = s.value;
}

// Where the forces balance, J(y) - J(x*) <= the sum of distance * multiplier.
template <int B>
double InteriorPointIteration<B>::error_bound() const {
  std::vector<double> moved(y_.size()), A_moved(y_.size());
  for (std::size_t i = 0; i < y_.size(); ++i) moved[i] = this->x_[i] - y_[i];
  product<B>(*level_.A, moved.data(), A_moved.data());
  double squared = 0;
  for (std::size_t i = 0; i < y_.size(); ++i) squared += moved[i] * A_moved[i];
  const double gap = complementarity(0) * static_cast<double>(sides_.size());
  return std::sqrt(2 * gap) + std::sqrt(std::max(squared, 0.0));
}

template <int B>
void InteriorPointIteration<B>::add_work(Stage& stage) const {
  stage.linear = linear_;
  stage.linear_solves = system_.solves();
  stage.factorisations = system_.factorisations();
}

// By the factorisation of the last step, where the multipliers are springs that hold what is at a bound.
template <int B>
std::optional<double> InteriorPointIteration<B>::response(const std::vector<double>& forces, double) {
  std::vector<double> d = forces;
  for (std::size_t i = 0; i < d.size(); ++i)
    if (held_[i]) d[i] = 0;
  if (!system_.solve(d)) return {};
  return std::sqrt(std::abs(dot(d, forces)));
}

template class InteriorPointIteration<1>;
template class InteriorPointIteration<2>;
template class InteriorPointIteration<3>;

}  // namespace signorini
