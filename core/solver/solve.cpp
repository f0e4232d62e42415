#include "core/solver/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/algebra/products.hpp"
#include "core/base/clock.hpp"
#include "core/base/error.hpp"
#include "core/solver/convergence.hpp"
#include "core/solver/multigrid.hpp"
#include "core/solver/recombination.hpp"

namespace signorini {

namespace {

// Part of the bound of rounding errors above which a gain counts: most of them cancel.
constexpr double noise = 0.1;

void require(bool holds, const char* key, const std::string& found, const char* expected) {
  if (!holds) input_error(fmt::format("solver.{}", key), fmt::format("found '{}', expected {}", found, expected));
}

// The value that a name stands for.
template <class T>
T choice(const char* key, const std::string& found, std::initializer_list<std::pair<const char*, T>> known) {
  std::string names;
  for (const auto& [name, value] : known) {
    if (found == name) return value;
    names += fmt::format("{}'{}'", names.empty() ? "" : " or ", name);
  }
  require(false, key, found, names.c_str());
  return {};
}

template <int B>
typename MonotoneMultigrid<B>::Settings settings_of(const SolverOptions& o) {
  require(o.pre >= 0 && o.post >= 0 && o.pre + o.post > 0, "pre", fmt::format("{}' and '{}", o.pre, o.post),
          "pre, post >= 0 and at least one smoothing step");
  require(o.tolerance > 0 && o.tolerance < 1, "tolerance", fmt::format("{}", o.tolerance), "a number in (0, 1)");
  require(o.max_iterations >= 1, "max_iterations", fmt::format("{}", o.max_iterations), "at least 1");
  require(o.cut >= 0 && o.cut <= 100, "cut", fmt::format("{}", o.cut), "a number in [0, 100]");
  require(o.relaxation > 0 && o.relaxation < 2, "relaxation", fmt::format("{}", o.relaxation), "a number in (0, 2)");
  require(o.threads >= 1 && o.threads <= 4096, "threads", fmt::format("{}", o.threads), "a number from 1 to 4096");
  const bool tnnmg = choice<bool>("method", o.method, {{"monotone", false}, {"tnnmg", true}, {"pgs", false}});
  const auto truncate = choice<Truncation>(
      "truncate", o.truncate,
      {{"none", Truncation::none}, {"normal", Truncation::normal}, {"tangential", Truncation::tangential}});
  require(!tnnmg || truncate != Truncation::none, "truncate", o.truncate,
          "'normal' or 'tangential' with method 'tnnmg', whose coarse corrections have no bounds");
  require(tnnmg || o.transfer != "none", "transfer", o.transfer,
          "a monotone restriction, or method 'tnnmg', whose coarse corrections have no bounds");
  return {o.pre,
          o.post,
          choice<Cycle>("cycle", o.cycle, {{"V", Cycle::V}, {"W", Cycle::W}, {"F", Cycle::F}}),
          truncate,
          choice<Rotate>("rotate", o.rotate,
                         {{"all", Rotate::all}, {"not_coarsest", Rotate::not_coarsest}, {"none", Rotate::none}}),
          tnnmg,
          o.relaxation,
          o.threads};
}

template <int B>
Components<B> components_of(const SolverOptions& o, const Registry& registry) {
  const std::string transfer = o.method == "tnnmg" ? "none" : o.transfer;
  registry.create<Transfer<B>>("transfer", transfer);  // an unknown name shows here
  return {registry.create<Smoother<B>>("smoother", o.smoother),
          [&registry, transfer] { return registry.create<Transfer<B>>("transfer", transfer); },
          registry.create<CoarseSolver<B>>("coarse", o.method == "pgs" ? "pgs" : o.coarse)};
}

// Projected Gauss-Seidel alone is what is left without coarser levels.
std::span<const Prolongation> hierarchy_of(const SolverOptions& o, std::span<const Prolongation> prolongations) {
  return o.method == "pgs" ? std::span<const Prolongation>{} : prolongations;
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
        multigrid_(problem, hierarchy_of(options, prolongations), components_of<B>(options, registry),
                   settings_of<B>(options)),
        recombination_(problem.constraints),
        r_(x.size()),
        x_before_(x.size()),
        r_before_(x.size()) {}

  Summary run(const Monitor& monitor) {
    summary_.level_unknowns = unknowns();
    for (Index p = 0; p < problem_.A.size(); ++p)
      for (int k = 0; k < B; ++k) trace_ += problem_.A.diagonal(p)[k * B + k];
    reference_ = residual_at_projected_zero();
    make_admissible(problem_, x_);
    x_before_ = x_;
    refuse_nan(evaluate(x_, r_).natural_residual);
    while (!step(monitor)) {
    }
    summary_.rate = estimate_.rate();
    finish_phases();
    return std::move(summary_);
  }

 private:
  bool step(const Monitor& monitor) {
    r_before_.swap(r_);
    multigrid_.cut_below(options_.cut * sums_.moved);
    sums_ = {};
    const CycleReport cycle = multigrid_.cycle(
        x_.data(),
        [this](Index first, Index last) {
          std::copy(x_.begin() + Offset{first} * B, x_.begin() + Offset{last} * B,
                    x_before_.begin() + Offset{first} * B);
        },
        [this](Index first, Index last) { evaluate(x_, r_, first, last, sums_); });
    const bool combined = options_.krylov && options_.method != "pgs" && accelerate(cycle);
    refuse_nan(sums_.natural_residual);
    add_gain();
    measure();
    if (combined && within_tolerance()) {  // claimed for a residual that was not computed from the iterate alone
      sums_ = evaluate(x_, r_);
      measure();
    }
    record(cycle);
    const bool go_on = !monitor || monitor(summary_.history.back());
    if (finished()) return true;
    if (!cycle.bounded && !rests_at_rounding())
      return end(Outcome::unbounded, "the energy is unbounded below: nothing holds the body against the loads");
    if (!go_on) return end(Outcome::interrupted, "interrupted");
    if (summary_.iterations >= options_.max_iterations)
      return end(Outcome::iteration_limit,
                 fmt::format("iteration limit {}: residual {:.3e}, algebraic error {:.3e}, tolerance {:.3e}",
                             options_.max_iterations, summary_.residual, summary_.algebraic_error, options_.tolerance));
    return false;
  }

  // Worth it once few phases change, and while the gain is more than rounding, which directions without energy bring
  // in. Returns whether the iterate is no longer the cycle's own.
  bool accelerate(const CycleReport& cycle) {
    if (100 * cycle.finest().changed > cycle.finest().critical ||
        !(sums_.gain > noise * sums_.moved * cycle.rounding)) {
      recombination_.reset();
      return false;
    }
    return recombination_.propose(x_before_, r_before_, x_, r_) && take_combination();
  }

  // If it has the lower energy.
  bool take_combination() {
    x_trial_.resize(x_.size());
    r_trial_.resize(x_.size());
    Sums sums;
    const Chunks& chunks = multigrid_.finest().chunks;
    for (Index first = 0; first < chunks.vectors; first += chunks.size) {
      const Index last = std::min(chunks.vectors, first + chunks.size);
      recombination_.combine(x_before_, r_before_, first, last, x_trial_, r_trial_);
      add_sums(x_trial_, r_trial_, first, last, sums);
    }
    if (!(sums.gain >= sums_.gain)) {
      recombination_.reset();
      return false;
    }
    x_.swap(x_trial_);
    r_.swap(r_trial_);
    sums_ = sums;
    return true;
  }

  // Everything that is recomputed from an iterate, and what was gained since x_before_.
  struct Sums {
    double natural_residual = 0;
    double gain = 0, correction = 0, size = 0;  // J(before) - J, squared energy norm of the step, and their terms
    FreeProducts products;
    double largest = 0;  // |x|
    double moved = 0;    // the largest |step|
  };

  Sums evaluate(std::vector<double>& x, std::vector<double>& r) const {
    Sums sums;
    evaluate(x, r, 0, problem_.A.size(), sums);
    return sums;
  }

  void evaluate(std::vector<double>& x, std::vector<double>& r, Index first, Index last, Sums& sums) const {
    residual<B>(problem_.A, x.data(), problem_.b.data(), first, last, r.data() + Offset{first} * B);
    add_sums(x, r, first, last, sums);
  }

  void add_sums(std::vector<double>& x, const std::vector<double>& r, Index first, Index last, Sums& sums) const {
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
    sums.gain += gain;
    sums.correction += correction;
    sums.size += size;
    sums.largest = largest;
    sums.moved = moved;
    sums.products += free_products(problem_, x, r, first, last);
  }

  void add_natural_residual(std::vector<double>& x, Index first, Index last, const std::vector<double>& r,
                            double& largest) const {
    const Level<B>& level = multigrid_.finest();
    LevelView<B> view = level.view();
    view.x = x.data();
    level.for_each_segment(first, last, Order::forward, [&](const Segment<B>& s, Index begin, Index end) {
      const double found = s.obstacle->natural_residual(view, begin, end, r.data());
      if (!(found <= largest)) largest = found;  // NaN stays visible
    });
  }

  void add_gain() {
    refuse_nan(sums_.size);
#ifdef SIGNORINI_CHECKS
    assert(sums_.gain >= -1e-8 * sums_.size - rounding_of_gain() && "the energy must never grow");
#endif
    estimate_.add(sums_.gain, std::sqrt(std::max(sums_.correction, 0.0)));
  }

  void measure() {
    Summary& s = summary_;
    s.residual = reference_ > 0 ? sums_.natural_residual / reference_ : sums_.natural_residual;
    double squared = energy_norm_squared(problem_, x_, sums_.products);
    if (squared <= trace_ * sums_.largest * sums_.largest * 1e-14) squared = std::max(squared, rounding_energy());
    const double size = std::sqrt(squared);
    s.algebraic_error = estimate_.error() == 0 ? 0 : size > 0 ? estimate_.error() / size : 1;
    s.energy = energy(problem_, sums_.products);
  }

  void record(const CycleReport& cycle) {
    Summary& s = summary_;
    ++s.iterations;
    s.history.push_back({s.iterations, s.residual, s.algebraic_error, s.energy, cycle.finest().critical,
                         cycle.finest().changed, cycle.levels});
  }

  // What rounding leaves of x'Ax for a rigid motion, which has no energy.
  double rounding_energy() const {
    double sum = 0;
    for (Index p = 0; p < problem_.A.size(); ++p)
      for (int k = 0; k < B; ++k)
        if (const double v = x_[Offset{p} * B + k]; !(problem_.fixed[p] >> k & 1u))
          sum += problem_.A.diagonal(p)[k * B + k] * v * v;
    return 16 * std::numeric_limits<double>::epsilon() * sum;
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

  bool within_tolerance() const {
    return summary_.residual <= options_.tolerance && summary_.algebraic_error <= options_.tolerance;
  }

  bool finished() {
    Summary& s = summary_;
    const double absolute = sums_.natural_residual;
    if (within_tolerance())
      return end(Outcome::converged, fmt::format("residual {:.3e} and algebraic error {:.3e} are at most {:.3e}",
                                                 s.residual, s.algebraic_error, options_.tolerance));
    stalled_ = absolute > 0.5 * least_ ? stalled_ + 1 : 0;
    least_ = std::min(least_, absolute);
    if (stalled_ >= 3 && rests_at_rounding() && s.algebraic_error <= 1e-4)
      return end(Outcome::rounding, fmt::format("the residual rests at {:.3e}, which is rounding", s.residual));
    return false;
  }

  // Natural residuals below a small multiple of machine precision times the largest unknown say nothing, unless it is
  // the iteration that carried the unknowns away.
  bool rests_at_rounding() const {
    return sums_.natural_residual <= 1000 * std::numeric_limits<double>::epsilon() * sums_.largest &&
           summary_.residual <= 1e-3;
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

  // Where it is zero the projected zero is the solution, and no other start has a scale to be measured by.
  double residual_at_projected_zero() {
    make_admissible(problem_, x_before_);
    const double found = evaluate(x_before_, r_).natural_residual;
    if (found == 0) x_ = x_before_;
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
  Sums sums_;
  double trace_ = 0;  // of A
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
