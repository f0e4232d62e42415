#include "core/solver/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

#include "core/algebra/products.hpp"
#include "core/base/error.hpp"
#include "core/solver/convergence.hpp"
#include "core/solver/multigrid.hpp"
#include "core/solver/recombination.hpp"

namespace signorini {

namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void require(bool holds, const char* key, const std::string& found, const char* expected) {
  if (!holds) input_error(fmt::format("solver.{}", key), fmt::format("found '{}', expected {}", found, expected));
}

template <int B>
typename MonotoneMultigrid<B>::Settings settings_of(const SolverOptions& o) {
  require(o.method == "monotone", "method", o.method, "'monotone'");
  require(o.cycle == "V" || o.cycle == "W", "cycle", o.cycle, "'V' or 'W'");
  require(o.truncate == "normal" || o.truncate == "none", "truncate", o.truncate, "'normal' or 'none'");
  require(o.rotate == "all" || o.rotate == "not_coarsest" || o.rotate == "none", "rotate", o.rotate,
          "'all', 'not_coarsest' or 'none'");
  require(o.pre >= 0 && o.post >= 0 && o.pre + o.post > 0, "pre", fmt::format("{}' and '{}", o.pre, o.post),
          "pre, post >= 0 and at least one smoothing step");
  require(o.tolerance > 0 && o.tolerance < 1, "tolerance", fmt::format("{}", o.tolerance), "a number in (0, 1)");
  require(o.max_iterations >= 1, "max_iterations", fmt::format("{}", o.max_iterations), "at least 1");
  return {o.pre, o.post, o.cycle == "V" ? 1 : 2, o.truncate == "normal",
          o.rotate == "all"    ? Rotate::all
          : o.rotate == "none" ? Rotate::none
                               : Rotate::not_coarsest};
}

template <int B>
Components<B> components_of(const SolverOptions& o, const Registry& registry) {
  registry.create<Transfer<B>>("transfer", o.transfer);  // an unknown name shows here
  return {registry.create<Smoother<B>>("smoother", o.smoother),
          [&registry, id = o.transfer] { return registry.create<Transfer<B>>("transfer", id); },
          registry.create<CoarseSolver<B>>("coarse", o.coarse)};
}

// The admissible vector next to x: prescribed values and bounds.
template <int B>
void make_admissible(const DiscreteProblem<B>& problem, std::vector<double>& x) {
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) x[Offset{p} * B + k] = problem.start[Offset{p} * B + k];
  const Constraints<B>& c = problem.constraints;
  for (std::size_t slot = 0; slot < c.vector.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const std::size_t at = slot * B + static_cast<std::size_t>(k);
      double& v = x[Offset{c.vector[slot]} * B + k];
      v = v < c.lower[at] ? c.lower[at] : v > c.upper[at] ? c.upper[at] : v;  // NaN stays visible
    }
}

// The loop around the cycles: what is recomputed from the iterate after each of them, and when to stop.
template <int B>
class Solve {
 public:
  Solve(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations, std::vector<double>& x,
        const SolverOptions& options, const Registry& registry)
      : problem_(problem),
        options_(options),
        x_(x),
        multigrid_(problem, prolongations, components_of<B>(options, registry), settings_of<B>(options)),
        recombination_(problem.constraints, options.krylov ? x.size() : 0),
        r_(x.size()),
        x_before_(x.size()),
        r_before_(x.size()),
        x_trial_(options.krylov ? x.size() : 0),
        r_trial_(x_trial_.size()) {}

  Summary run(const Monitor& monitor) {
    summary_.level_unknowns = unknowns();
    reference_ = residual_at_projected_zero();
    make_admissible(problem_, x_);
    residual<B>(problem_.A, x_.data(), problem_.b.data(), r_.data());
    refuse_nan(natural_residual(x_, r_));
    while (!step(monitor)) {
    }
    summary_.rate = estimate_.rate();
    finish_phases();
    return std::move(summary_);
  }

 private:
  bool step(const Monitor& monitor) {
    x_before_ = x_;
    r_before_ = r_;
    const CycleReport cycle = multigrid_.cycle(x_.data());
    residual<B>(problem_.A, x_.data(), problem_.b.data(), r_.data());
    if (options_.krylov) accelerate(cycle);
    const double absolute = natural_residual(x_, r_);
    refuse_nan(absolute);
    add_gain();
    record(cycle, absolute);
    const bool go_on = !monitor || monitor(summary_.history.back());
    if (finished(absolute)) return true;
    if (!cycle.bounded && absolute > rounding_level())
      return end(Outcome::unbounded, "the energy is unbounded below: nothing holds the body against the loads");
    if (!go_on) return end(Outcome::interrupted, "interrupted");
    if (summary_.iterations >= options_.max_iterations)
      return end(Outcome::iteration_limit,
                 fmt::format("iteration limit {}: residual {:.3e}, algebraic error {:.3e}, tolerance {:.3e}",
                             options_.max_iterations, summary_.residual, summary_.algebraic_error, options_.tolerance));
    return false;
  }

  // Worth it once few phases change.
  void accelerate(const CycleReport& cycle) {
    if (100 * cycle.changed > cycle.contact)
      recombination_.reset();
    else if (recombination_.propose(x_before_, r_before_, x_, r_, x_trial_))
      choose_trial();
  }

  // The trial, if it has the lower energy, with its residual computed anew.
  void choose_trial() {
    residual<B>(problem_.A, x_trial_.data(), problem_.b.data(), r_trial_.data());
    if (gain(x_trial_, r_trial_) >= gain(x_, r_)) {
      x_.swap(x_trial_);
      r_.swap(r_trial_);
    } else {
      recombination_.reset();
    }
  }

  double gain(const std::vector<double>& x, const std::vector<double>& r) const {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += 0.5 * (x[i] - x_before_[i]) * (r_before_[i] + r[i]);
    return sum;
  }

  // J(before) - J(x) = d'(r_before + r) / 2 and ||d||_A^2 = d'(r_before - r): no cancellation of energies.
  void add_gain() {
    double gain = 0, correction = 0, size = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double d = x_[i] - x_before_[i];
      gain += 0.5 * d * (r_before_[i] + r_[i]);
      correction += d * (r_before_[i] - r_[i]);
      size += std::abs(d * r_before_[i]) + std::abs(d * r_[i]);
    }
#ifdef SIGNORINI_CHECKS
    assert(gain >= -1e-8 * size - rounding_of_gain() && "the energy must never grow");
#endif
    refuse_nan(size);
    estimate_.add(gain, std::sqrt(std::max(correction, 0.0)));
  }

  void record(const CycleReport& cycle, double absolute) {
    Summary& s = summary_;
    ++s.iterations;
    s.residual = reference_ > 0 ? absolute / reference_ : absolute;
    const double size = std::sqrt(std::max(energy_norm_squared(problem_, x_, r_), rounding_energy()));
    s.algebraic_error = estimate_.error() == 0 ? 0 : size > 0 ? estimate_.error() / size : 1;
    s.energy = energy(problem_, x_, r_);
    s.history.push_back({s.iterations, s.residual, s.algebraic_error, s.energy, cycle.contact, cycle.changed});
  }

#ifdef SIGNORINI_CHECKS
  // The residuals are exact to rounding of the forces in them.
  double rounding_of_gain() const {
    double moved = 0, force = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      if (problem_.fixed[i / B] >> (i % B) & 1u) continue;
      moved += std::abs(x_[i] - x_before_[i]);
      const double stiffness = problem_.A.diagonal(static_cast<Index>(i / B))[i % B * (B + 1)];
      force = std::max(force, std::abs(problem_.b[i]) + stiffness * std::abs(x_[i]));
    }
    return 1e-13 * moved * force;
  }
#endif

  // What rounding leaves of x'Ax for a rigid motion, which has no energy.
  double rounding_energy() const {
    double sum = 0;
    for (Index p = 0; p < problem_.A.size(); ++p)
      for (int k = 0; k < B; ++k)
        if (const double v = x_[Offset{p} * B + k]; !(problem_.fixed[p] >> k & 1u))
          sum += problem_.A.diagonal(p)[k * B + k] * v * v;
    return 16 * std::numeric_limits<double>::epsilon() * sum;
  }

  bool finished(double absolute) {
    Summary& s = summary_;
    if (s.residual <= options_.tolerance && s.algebraic_error <= options_.tolerance)
      return end(Outcome::converged, fmt::format("residual {:.3e} and algebraic error {:.3e} are at most {:.3e}",
                                                 s.residual, s.algebraic_error, options_.tolerance));
    stalled_ = absolute > 0.5 * least_ ? stalled_ + 1 : 0;
    least_ = std::min(least_, absolute);
    if (stalled_ >= 3 && absolute <= rounding_level() && s.algebraic_error <= 1e-4)
      return end(Outcome::rounding, fmt::format("the residual rests at {:.3e}, which is rounding", s.residual));
    return false;
  }

  // Natural residuals below a small multiple of machine precision times the largest unknown say nothing.
  double rounding_level() const {
    double largest = 0;
    for (const double v : x_) largest = std::max(largest, std::abs(v));
    return 1000 * std::numeric_limits<double>::epsilon() * largest;
  }

  bool end(Outcome outcome, std::string reason) {
    summary_.outcome = outcome;
    summary_.reason = std::move(reason);
    return true;
  }

  void finish_phases() {
    const auto& history = summary_.history;
    int from = 0;
    for (auto it = history.rbegin(); it != history.rend() && it->changed == 0; ++it) from = it->iteration;
    summary_.linear_phase_from = from;
  }

  double natural_residual(std::vector<double>& x, const std::vector<double>& r) const {
    const Level<B>& level = multigrid_.finest();
    LevelView<B> view = level.view();
    view.x = x.data();
    double largest = 0;
    for (const Segment<B>& s : level.segments) {
      const double found = s.obstacle->natural_residual(view, s.first, s.last, r.data());
      if (!(found <= largest)) largest = found;
    }
    return largest;
  }

  // Where it is zero the projected zero is the solution, and no other start has a scale to be measured by.
  double residual_at_projected_zero() {
    std::vector<double> zero(x_.size(), 0.0);
    make_admissible(problem_, zero);
    residual<B>(problem_.A, zero.data(), problem_.b.data(), r_.data());
    const double found = natural_residual(zero, r_);
    if (found == 0) x_ = std::move(zero);
    return found;
  }

  std::vector<Index> unknowns() const {
    std::vector<Index> count;
    for (const Level<B>& level : multigrid_.levels()) {
      Index free = 0;
      for (const Flags off : level.off)
        for (int k = 0; k < B; ++k) free += !(off >> k & 1u);
      count.push_back(free);
    }
    return count;
  }

  static void refuse_nan(double residual) {
    if (!std::isfinite(residual))
      throw Error(Exit::input,
                  "solver: the residual is not finite; the matrix, the loads or the start hold values that "
                  "are infinite, NaN or too large to square");
  }

  const DiscreteProblem<B>& problem_;
  const SolverOptions& options_;
  std::vector<double>& x_;
  MonotoneMultigrid<B> multigrid_;
  Recombination<B> recombination_;
  std::vector<double> r_, x_before_, r_before_;
  std::vector<double> x_trial_, r_trial_;  // empty without acceleration
  ErrorEstimate estimate_;
  Summary summary_;
  double reference_ = 0;
  double least_ = infinity;
  int stalled_ = 0;
};

}  // namespace

template <int B>
Summary solve(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations, std::vector<double>& x,
              const SolverOptions& options, const Registry& registry, const Monitor& monitor) {
  const double begin = seconds();
  Solve<B> loop(problem, prolongations, x, options, registry);
  const double ready = seconds();
  Summary summary = loop.run(monitor);
  summary.setup_seconds = ready - begin;
  summary.solve_seconds = seconds() - ready;
  return summary;
}

template Summary solve(const DiscreteProblem<1>&, std::span<const Prolongation>, std::vector<double>&,
                       const SolverOptions&, const Registry&, const Monitor&);
template Summary solve(const DiscreteProblem<2>&, std::span<const Prolongation>, std::vector<double>&,
                       const SolverOptions&, const Registry&, const Monitor&);
template Summary solve(const DiscreteProblem<3>&, std::span<const Prolongation>, std::vector<double>&,
                       const SolverOptions&, const Registry&, const Monitor&);

}  // namespace signorini
