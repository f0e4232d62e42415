#include "methods/newton.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/algebra/products.hpp"
#include "core/base/clock.hpp"
#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/multigrid.hpp"
#include "methods/direct_newton_system.hpp"
#include "methods/load_renewal.hpp"
#include "methods/multigrid_newton_system.hpp"
#include "methods/stages.hpp"

namespace signorini {

namespace {

constexpr double slip_stiffness = 1e-3;  // of that of the vector
constexpr double least_step = 1.0 / 32;

template <int B>
bool treats_not(const Segment<B>& s) {
  return s.obstacle->functional() && !s.obstacle->friction();
}

template <int B>
std::unique_ptr<NewtonSystem<B>> system_of(const DiscreteProblem<B>& problem,
                                           std::span<const Prolongation> prolongations, const SolverOptions& options,
                                           const Registry& registry) {
  if (!problem.following && !prolongations.empty() &&
      !automatic::may_factorise_for_newton(B, Offset{problem.A.size()} * B))
    return std::make_unique<MultigridNewtonSystem<B>>(problem, prolongations, options, registry);
  return std::make_unique<DirectNewtonSystem<B>>(problem.A, problem.following,
                                                 registry.create<UnsymmetricSolver>("unsymmetric", "umfpack"));
}

}  // namespace

template <int B>
NewtonIteration<B>::NewtonIteration(const DiscreteProblem<B>& problem, std::vector<double>& x,
                                    const SolverOptions& options, const Registry& registry,
                                    std::span<const Prolongation> prolongations)
    : Iteration<B>(problem, x, options),
      level_(finest_level(problem)),
      load_(problem.following),
      system_(system_of(problem, prolongations, options, registry)) {
  check(problem);
  read_laws();
}

template <int B>
bool NewtonIteration<B>::suits(const DiscreteProblem<B>& problem) {
  return problem.constraints.facet.empty() && (problem.following || has_functional(problem.segments)) &&
         std::ranges::none_of(problem.segments, treats_not<B>);
}

template <int B>
void NewtonIteration<B>::check(const DiscreteProblem<B>& problem) {
  const Constraints<B>& c = problem.constraints;
  if (!c.facet.empty())
    input_error("solver.method",
                "'newton' treats one direction of contact at a vertex, and obstacles hold some along "
                "several; expected 'auto', 'monotone', 'tnnmg' or 'pgs'");
  for (const Segment<B>& s : problem.segments)
    if (treats_not(s))
      input_error("solver.method",
                  "'newton' treats bounds and friction, and an obstacle adds something else to the "
                  "energy; expected 'auto', 'monotone', 'tnnmg' or 'pgs'");
}

template <int B>
void NewtonIteration<B>::read_laws() {
  const Constraints<B>& c = level_.constraints;
  const auto slots = static_cast<std::size_t>(c.size());
  laws_.assign(slots, {});
  tangential_.assign(slots, 0);
  states_.assign(slots, {});
  for (const Segment<B>& s : level_.segments) {
    const Friction* friction = s.obstacle->friction();
    const auto [from, to] = slots_between(c, s.first, s.last);
    for (Index slot = from; friction && slot < to; ++slot) {
      laws_[slot] = friction->law(c.data.data() + Offset{slot} * c.width);
      tangential_[slot] = c.tangential[slot];
    }
  }
  stiffness_.resize(slots * B);
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k)
      stiffness_[Offset{slot} * B + k] = this->problem_.A.diagonal(c.vector[slot])[k * (B + 1)];
}

template <int B>
Complementarity<B> NewtonIteration<B>::equations(Index slot) const {
  const Constraints<B>& c = level_.constraints;
  const Offset at = Offset{slot} * B;
  return {c.lower.data() + at,
          c.upper.data() + at,
          level_.off[c.vector[slot]],
          tangential_[slot],
          c.last.empty() ? nullptr : c.last.data() + at,
          laws_[slot],
          stiffness_.data() + at,
          slip_stiffness * largest_stiffness(slot)};
}

/// All equations and their derivatives at y_, the latter as rows of a matrix.
template <int B>
void NewtonIteration<B>::linearise() {
  double unit[B * B] = {}, none[B * B] = {};
  for (int k = 0; k < B; ++k) unit[k * (B + 1)] = 1;
  d_ = force_;
  for (Index p = 0; p < level_.vectors; ++p) {
    const Index slot = level_.constraints.slot[p];
    if (slot < 0) {
      system_->set_row(p, unit, none);
      continue;
    }
    const Offset at = Offset{p} * B;
    double by_force[B * B], by_value[B * B];
    states_[slot] = equations(slot).evaluate(y_.data() + at, force_.data() + at, d_.data() + at, by_force, by_value);
    system_->set_row(p, by_force, by_value);
  }
  if (!load_) return;
  load_->correct(y_, change_, of_load_);
  d_.insert(d_.end(), of_load_.begin(), of_load_.end());
}

/// How far y_ is from solving the equations: squares of forces over stiffnesses.
template <int B>
double NewtonIteration<B>::merit() {
  double sum = 0, unused[2 * B * B];
  if (load_) {
    load_->correct(y_, change_, of_load_);
    sum += dot(change_, of_load_);
  }
  for (Index p = 0; p < level_.vectors; ++p) {
    const Index slot = level_.constraints.slot[p];
    const Offset at = Offset{p} * B;
    double C[B];
    std::copy_n(force_.data() + at, B, C);
    if (slot >= 0) equations(slot).evaluate(y_.data() + at, force_.data() + at, C, unused, unused + B * B);
    for (int k = 0; k < B; ++k) sum += C[k] * C[k] / this->problem_.A.diagonal(p)[k * (B + 1)];
  }
  return sum;
}

template <int B>
void NewtonIteration<B>::renew_force() {
  residual<B>(this->problem_.A, y_.data(), this->problem_.b.data(), force_.data());
  for (double& f : force_) f = -f;
}

/// One step from y_, shorter where the full one leads away: false where the matrix is singular.
template <int B>
bool NewtonIteration<B>::solve() {
  const double before = merit();
  linearise();
  if (!system_->factorise() || !system_->solve(d_)) return false;
  const std::vector<double> start = y_;
  if (load_) load_start_ = load_->values();
  double best = infinity, part = 1;
  for (double t = 1; t >= least_step; t *= 0.5) {
    go(start, t);
    const double now = merit();
    if (now < best) best = now, part = t;
    if (now < before) break;
  }
  go(start, part);
  return true;
}

template <int B>
void NewtonIteration<B>::go(const std::vector<double>& start, double part) {
  for (std::size_t i = 0; i < y_.size(); ++i) y_[i] = start[i] - part * d_[i];
  for (std::size_t k = 0; k < load_start_.size(); ++k)
    change_[k] = load_start_[k] - part * d_[y_.size() + k] - load_->values()[k];
  if (load_) load_->add(change_, this->r_before_);
  renew_force();
}

template <int B>
double NewtonIteration<B>::largest_stiffness(Index slot) const {
  return *std::max_element(stiffness_.begin() + Offset{slot} * B, stiffness_.begin() + (Offset{slot} + 1) * B);
}

template <int B>
typename NewtonIteration<B>::Step NewtonIteration<B>::advance() {
  const double begin = seconds();
  this->x_before_ = this->x_;
  if (system_->factorisations() == 0) {
    y_ = this->x_;
    force_ = this->r_before_;
    for (double& f : force_) f = -f;
  }
  const std::vector<State> last = states_;
  const bool solved = solve();
  put_onto_sets();
  this->sums_ = this->evaluate(this->x_, this->r_);
  this->refuse_nan(this->sums_.natural_residual);
  if (load_) measure_load();
  Step step;
  // The step itself bounds the error of the iterate before.
  step.error = solved ? std::sqrt(std::abs(this->sums_.correction)) : infinity;
  if (!solved) step.stuck = "the matrix of Newton's method is singular: nothing holds the body there";
  step.levels = {report(last)};
  step.levels.front().renewed = level_.vectors;
  step.levels.front().seconds = seconds() - begin;
  return step;
}

/// What is left to be corrected of a load that follows, after the step.
template <int B>
void NewtonIteration<B>::measure_load() {
  load_->correct(this->x_, change_, of_load_);
  this->sums_.correction += dot(change_, of_load_);
  this->residual_of_load_ = relative_change(change_, *load_);
}

/// What touches is on its bound, and what sticks where it was.
template <int B>
void NewtonIteration<B>::put_onto_sets() {
  const Constraints<B>& c = level_.constraints;
  this->x_ = y_;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const State& state = states_[slot];
      const Offset at = Offset{slot} * B + k;
      double& x = this->x_[Offset{c.vector[slot]} * B + k];
      if (state.side[k] != 0) x = state.side[k] < 0 ? c.lower[at] : c.upper[at];
      if (rests_on(slot, k)) x = c.last[at];
    }
  make_admissible(this->problem_, this->x_);
}

template <int B>
bool NewtonIteration<B>::rests_on(Index slot, int k) const {
  return states_[slot].friction == Complementarity<B>::Friction::sticks && (tangential_[slot] >> k & 1u) &&
         !(level_.off[level_.constraints.vector[slot]] >> k & 1u);
}

template <int B>
LevelReport NewtonIteration<B>::report(const std::vector<State>& last) const {
  LevelReport out;
  out.vectors = level_.vectors;
  for (Index slot = 0; slot < level_.constraints.size(); ++slot) {
    bool critical = false;
    for (int k = 0; k < B; ++k) {
      const bool holds = states_[slot].side[k] != 0 || rests_on(slot, k);
      out.contact[static_cast<std::size_t>(k)] += holds;
      critical = critical || holds;
    }
    out.critical += critical;
    out.changed += !(states_[slot] == last[slot]);
  }
  return out;
}

template <int B>
void NewtonIteration<B>::add_work(Stage& stage) const {
  stage.linear = system_->name();
  stage.linear_solves = system_->solves();
  stage.factorisations = system_->factorisations();
}

// By the matrix of the last step.
template <int B>
std::optional<double> NewtonIteration<B>::response(const std::vector<double>& forces, double) {
  std::vector<double> d = forces;
  const Constraints<B>& c = level_.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k)
      if (states_[slot].side[k] != 0 || rests_on(slot, k)) d[Offset{c.vector[slot]} * B + k] = 0;
  d.resize(static_cast<std::size_t>(system_->size()));
  if (!system_->solve(d)) return {};
  return std::sqrt(std::abs(std::inner_product(forces.begin(), forces.end(), d.begin(), 0.0)));
}

template class NewtonIteration<1>;
template class NewtonIteration<2>;
template class NewtonIteration<3>;

}  // namespace signorini
