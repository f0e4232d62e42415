#include "methods/multigrid_iteration.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/solver/functional.hpp"
#include "core/solver/rounding.hpp"
#include "core/solver/smooth_interpolation.hpp"
#include "core/solver/sticking.hpp"
#include "methods/automatic.hpp"

namespace signorini {

namespace {

// Part of the bound of rounding errors above which a gain counts: most of them cancel.
constexpr double noise = 0.1;
// How much of that bound there mostly is, times the square root of the number of forces: their errors add up at random.
constexpr double typical = 0.01;
// Residual of a start whose phases are mostly those of the solution; interpolated from a coarser mesh it is mostly
// larger.
constexpr double near_start = 0.01;

bool has_blocks(std::span<const Prolongation> prolongations) {
  return std::ranges::any_of(prolongations, [](const Prolongation& P) { return !P.block.empty(); });
}

/// Coarse solvers know boxes only: where the single level has functionals or facets, they get one of their own below
/// it, on which these are linear.
template <int B>
std::vector<Prolongation> linear_level(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                                       Method method) {
  const bool boxes = !has_functional(problem.segments) && problem.constraints.facet.empty();
  if (method == Method::pgs || !prolongations.empty() || boxes) return {};
  Prolongation identity;
  identity.coarse = problem.A.size();
  for (Index p = 0; p < identity.coarse; ++p) {
    identity.column.push_back(p);
    identity.row.push_back(Offset{p} + 1);
  }
  identity.weight.assign(identity.column.size(), 1.0);
  return {std::move(identity)};
}

bool rests(const LevelReport& finest) { return 100 * finest.changed <= automatic::resting_percent * finest.critical; }

// For acceleration beside functionals and loads that follow, with which phases come to rest layer by layer, a few in
// each cycle.
bool mostly_rests(const LevelReport& finest) { return 2 * finest.changed <= finest.critical; }

}  // namespace

template <int B>
MultigridIteration<B>::MultigridIteration(const DiscreteProblem<B>& problem,
                                          std::span<const Prolongation> prolongations, std::vector<double>& x,
                                          const SolverOptions& options, Components<B> components,
                                          const automatic::Situation& situation, const automatic::Patience& patience)
    : Iteration<B>(problem, x, options),
      method_(check_options(options)),
      situation_(situation),
      patience_(patience),
      own_(linear_level<B>(problem, prolongations, method_)),
      multigrid_(problem, own_.empty() ? prolongations : own_, std::move(components), settings_of<B>(options)),
      recombination_(multigrid_.finest().constraints),
      blocks_(has_blocks(prolongations)),
      smooth_(B == 1 && !prolongations.empty() && is_smooth(prolongations.back())),
      may_turn_(method_ == Method::automatic && automatic::may_turn(options)),
      nonlinear_(multigrid_.finest().nonlinear) {
  this->careful_ = multigrid_.of_fourth_order();
  if (problem.following) load_.emplace(*problem.following, multigrid_.finest().constraints, options.tolerance);
  if (this->follows() && problem.loose) stick_everywhere(problem, x);
}

template <int B>
std::vector<Index> MultigridIteration<B>::unknowns() const {
  std::vector<Index> count;
  for (const Level<B>& level : multigrid_.levels()) count.push_back(this->free_unknowns(level));
  return count;
}

template <int B>
typename MultigridIteration<B>::Step MultigridIteration<B>::advance() {
  Sums& sums = this->sums_;
  if (cycles_ == 0) begin_where_it_rests();
  multigrid_.cut_below(this->options_.cut * sums.moved);
  const bool free = goes_without_bounds();
  multigrid_.search_lines(free);
  multigrid_.extend_steps(!free && may_turn_ && rests_);
  if (this->follows()) renew();
  ++cycles_;
  sums = {};
  recombination_.begin();
  amplification_ = recombination_.amplification();
  const CycleReport cycle = multigrid_.cycle(
      this->x_.data(),
      [this](Index first, Index last) {
        std::copy(this->x_.begin() + Offset{first} * B, this->x_.begin() + Offset{last} * B,
                  this->x_before_.begin() + Offset{first} * B);
      },
      [this](Index first, Index last) {
        in_pieces<B>(first, last, [this](Index from, Index to) {
          this->evaluate(this->x_, this->r_, from, to, this->sums_);
          recombination_.add(this->x_before_, this->x_, from, to);
        });
      });
  const bool gaining =
      sums.gain > noise * sums.moved * cycle.rounding && (!this->careful_ || sums.gain > this->storage_energy());
  if (nonlinear_ && this->options_.krylov && !load_) renew_forces();
  if (load_) renew_load(cycle.finest());
  const bool combined = !load_ && this->options_.krylov && method_ != Method::pgs && accelerate(cycle, gaining);
  this->refuse_nan(sums.natural_residual);
  add_gain();
  const bool idle = sums.moved == 0 && sums.natural_residual > 0 && !this->rests_at_rounding();
  // A cycle that changes nothing leaves nothing but rounding, if that is how small the residual is.
  const bool settled = idle && this->relative_residual() <= this->options_.tolerance;
  const double error = settled ? 0 : idle ? infinity : remaining_error();
  // Where the linear model has no minimum, the functional may well have one.
  Step step{cycle.levels, error, estimate_.rate(), combined, cycle.bounded || free || nonlinear_, gaining, false, {}};
  rests_ = rests(cycle.finest()) && (!this->follows() || cycle.finest().critical > 0);
  compare_gains(free, cycle.cut_off);
  bounded_cycles_ += !free;
  if (free && !cycle.bounded) may_turn_ = false;  // what only the obstacle holds has no correction without bounds
  if (this->follows()) {
    renewal_.add(sums.natural_residual);
    step.stuck = renewal_.stuck();
  }
  if (load_ && load_->diverges()) step.stuck = "the cycles and the pressures of nearly incompressible material diverge";
  if (method_ != Method::automatic) return step;
  if (step.stuck.empty() && loses_patience()) {
    lost_patience_ = true;
    step.stuck = "the cycles converge too slowly";
  }
  if (idle && !settled && !nonlinear_ && !load_) step.stuck = "the cycles change nothing, but forces are left";
  return step;
}

// Where functionals or loads follow the solution the steps are those of a fixed point iteration, too.
template <int B>
double MultigridIteration<B>::remaining_error() const {
  return this->follows() || load_ ? std::max(estimate_.error(), estimate_.error_of_steps()) : estimate_.error();
}

// The forces on a start, which may be as rough as zero or an interpolation, bound friction by next to nothing: what
// that alone holds would slide away in the first cycle, and hardly come back. So nothing slips in that one.
template <int B>
void MultigridIteration<B>::renew() {
  std::vector<double>& frozen = multigrid_.frozen();
  if (cycles_ > 0 || !this->problem_.loose) return renewal_.next(this->data_, frozen);
  frozen = this->data_;
  functional::press_beyond_measure(multigrid_.finest(), this->x_.data(), frozen.data());
}

template <int B>
std::optional<double> MultigridIteration<B>::response(const std::vector<double>& forces, double enough) {
  return multigrid_.response(this->x_, forces, enough);
}

// Phases of a start that is near are not news: without them the first cycle is nearly a linear one, and goes without
// bounds. (Blocks come to that by what bounds gain.)
template <int B>
void MultigridIteration<B>::begin_where_it_rests() {
  const double residual = this->relative_residual();
  if (B > 1 || nonlinear_ || load_ || !(residual > 0 && residual <= near_start)) return;
  multigrid_.begin_at(this->x_.data());
  rests_ = true;
}

// By the rate of the last cycles, which may change: asked again from time to time.
template <int B>
bool MultigridIteration<B>::loses_patience() const {
  const int left = std::min(patience_.most, this->options_.max_iterations) - cycles_;
  if (cycles_ < patience_.first || cycles_ % patience_.every != 0 || cycles_ >= this->options_.max_iterations)
    return false;
  automatic::Situation situation = situation_;
  situation.unknowns = this->free_unknowns(finest());
  situation.coarsest = this->free_unknowns(multigrid_.levels().front());
  if (!automatic::others_suit(situation)) return false;
  return !(this->excess() * std::pow(estimate_.rate(), std::max(left, 0)) <= 1);
}

// Bounds of coarse corrections keep contact from spreading too far; where it rests they mostly hold back, and where
// they are tight, as on algebraic levels, it spreads too slowly with them alone. The gains tell whether they pay after
// all: where a slender body comes to an obstacle with its tip, or where weights are blocks, which share a distance
// among so many components that they are asked from the second cycle on. Smooth interpolation reaches so far that its
// bounds hold back from the first cycle on. But what single vectors cut off of it leaves kinks, which an operator of
// fourth order hardly lets it take: a cycle with bounds then brings these vectors into contact.
template <int B>
bool MultigridIteration<B>::goes_without_bounds() const {
  if (method_ == Method::tnnmg) return true;
  if (!may_turn_) return false;
  if (smooth_) return !cut_off_;
  const bool may_bend = B > 1;
  if (blocks_ || (rests_ && may_bend)) return !bounds_pay_;
  if (rests_) return true;
  return cycles_ >= automatic::patience_with_bounds && cycles_ % 2 == 0;
}

// A correction that single vectors cut off gains little: bounds take over, until they gain no more than it did.
template <int B>
void MultigridIteration<B>::compare_gains(bool free, bool cut_off) {
  const double gain = this->sums_.gain;
  cut_off_ = free && cut_off;
  if (!free) {
    bounds_pay_ = gain > gain_without_bounds_;
  } else if ((blocks_ || cut_off) && gain > automatic::slow_gain * last_gain_) {
    bounds_pay_ = true;
    gain_without_bounds_ = gain;
  }
  last_gain_ = gain;
}

template <int B>
std::string MultigridIteration<B>::method() const {
  if (method_ != Method::automatic) return this->options_.method;
  if (bounded_cycles_ == 0) return "tnnmg";
  return bounded_cycles_ == cycles_ ? "monotone" : "monotone and tnnmg in turns";
}

// Worth it once few phases change, and while the gain is more than rounding, which directions without energy bring in.
// Returns whether the iterate is no longer the cycle's own.
template <int B>
bool MultigridIteration<B>::accelerate(const CycleReport& cycle, bool gaining) {
  const bool calm = nonlinear_ ? mostly_rests(cycle.finest()) : rests(cycle.finest());
  if (!calm || !gaining) {
    recombination_.reset();
    return false;
  }
  const std::vector<double>&before = nonlinear_ ? forces_before_ : this->r_before_,
        &now = nonlinear_ ? forces_ : this->r_;
  const bool lower = recombination_.propose(this->x_before_, before, this->x_, now, this->sums_.gain);
  if (lower && nonlinear_) recombination_.add_residuals(this->r_before_, this->r_);
  if (lower && take_combination(cycle)) {
    if (nonlinear_) set_forces();
    return true;
  }
  recombination_.reset();
  return false;
}

// After a cycle a load follows its iterate, which is judged with the load renewed. The energy was lowered for the load
// of before, which the sums of gains tell.
template <int B>
void MultigridIteration<B>::renew_load(const LevelReport& finest) {
  const bool accelerated = this->options_.krylov && method_ != Method::pgs && mostly_rests(finest);
  const auto renewed = load_->renew(this->x_before_, this->r_before_, this->x_, this->r_, accelerated);
  const Sums of_cycle = std::exchange(this->sums_, {});
  in_pieces<B>(0, multigrid_.finest().vectors, [&](Index first, Index last) {
    if (renewed.combined)
      this->evaluate(this->x_, this->r_, first, last, this->sums_);
    else
      this->add_sums(this->x_, this->r_, first, last, this->sums_);
  });
  this->sums_.gain = of_cycle.gain;
  this->sums_.size = of_cycle.size;
  this->sums_.correction = of_cycle.correction + renewed.squared;
  this->residual_of_load_ = renewed.change;
}

// The negative gradient of the energy with the functionals, where these are smooth.
template <int B>
void MultigridIteration<B>::set_forces() {
  forces_ = this->r_;
  multigrid_.subtract_gradient(this->x_.data(), forces_.data());
}

template <int B>
void MultigridIteration<B>::renew_forces() {
  if (forces_.empty() || this->follows()) {
    forces_ = this->r_before_;
    multigrid_.subtract_gradient(this->x_before_.data(), forces_.data());
  }
  forces_before_.swap(forces_);
  set_forces();
}

// If it is admissible and has the lower energy, by more than what rounding may make of extrapolated residuals.
template <int B>
bool MultigridIteration<B>::take_combination(const CycleReport& cycle) {
  auto [x_trial, r_trial] = multigrid_.spare();
  x_trial.resize(this->x_.size());
  r_trial.resize(this->x_.size());
  Sums sums;
  bool admissible = true;
  data_trial_ = this->data_;
  in_pieces<B>(0, multigrid_.finest().vectors, [&, &x_trial = x_trial, &r_trial = r_trial](Index first, Index last) {
    admissible = admissible && recombination_.combine(this->x_before_, this->r_before_, first, last, x_trial, r_trial);
    if (admissible) this->add_sums(x_trial, r_trial, first, last, sums);
  });
  data_trial_.swap(this->data_);
  if (!admissible) return false;
  if (!(sums.gain >= this->sums_.gain)) return false;
  const double bound = cycle.rounding > 0 ? cycle.rounding : rounding_of_work(multigrid_.finest());  // a single level
  const double rounding = typical * bound / std::sqrt(static_cast<double>(this->x_.size()));
  const bool falls_far = sums.gain > noise * std::abs(sums.products.bx);  // perhaps for ever, which is to be found out
  if (!falls_far && !(sums.gain > sums.moved * rounding * recombination_.amplification())) return false;
  this->x_.swap(x_trial);
  this->r_.swap(r_trial);
  this->data_.swap(data_trial_);
  this->sums_ = sums;
  return true;
}

template <int B>
void MultigridIteration<B>::add_gain() {
  const Sums& sums = this->sums_;
  this->refuse_nan(sums.size);
#ifdef SIGNORINI_CHECKS
  // A step between nearly parallel facets is known to rounding over their angle only: there this does not tell.
  if (this->problem_.constraints.facet.empty())
    assert(sums.gain >= -1e-8 * sums.size - rounding_of_gain() && "the energy must never grow");
#endif
  estimate_.add(sums.gain, std::sqrt(std::max(sums.correction, 0.0)));
}

// By the residuals of the last two iterates; that of the first one may be extrapolated.
template <int B>
double MultigridIteration<B>::rounding_of_gain() const {
  const DiscreteProblem<B>& problem = this->problem_;
  const double work = rounding_of_work<B>(problem.fixed, 0, problem.A.size(), [&](Index p, int k) {
    return std::abs(problem.b[Offset{p} * B + k]) + terms_of_product(problem.A, this->x_.data(), p, k) +
           terms_of_product(problem.A, this->x_before_.data(), p, k);
  });
  double forces = 0;  // where positions are known to rounding of those of the step before
  for (const Index p : problem.constraints.vector)
    for (int k = 0; k < B; ++k)
      forces += std::abs(this->r_[Offset{p} * B + k]) + std::abs(this->r_before_[Offset{p} * B + k]);
  const double of_positions = 4 * std::numeric_limits<double>::epsilon() * this->largest_before_ * forces;
  return (this->sums_.moved * work + of_positions) * (1 + amplification_);
}

template class MultigridIteration<1>;
template class MultigridIteration<2>;
template class MultigridIteration<3>;

}  // namespace signorini
