#include "amg/black_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "amg/black_box/block_obstacles.hpp"
#include "amg/black_box/block_rows.hpp"
#include "amg/black_box/falls_forever.hpp"
#include "amg/black_box/given_bounds.hpp"
#include "amg/black_box/given_levels.hpp"
#include "amg/black_box/go_on.hpp"
#include "amg/black_box/held_rows.hpp"
#include "amg/black_box/motions.hpp"
#include "amg/black_box/nested_start.hpp"
#include "amg/black_box/recognise_block.hpp"
#include "amg/black_box/refinement.hpp"
#include "amg/black_box/refuse_indefinite.hpp"
#include "amg/black_box/row_units.hpp"
#include "amg/coarsening/hierarchy.hpp"
#include "amg/registration.hpp"
#include "core/algebra/products.hpp"
#include "core/base/clock.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/constraints/admissible_sets.hpp"
#include "core/constraints/check_functionals.hpp"
#include "core/constraints/own_numbers.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/convergence.hpp"
#include "core/solver/local_coordinates.hpp"
#include "core/solver/sticking.hpp"
#include "methods/attempts.hpp"
#include "methods/configuration.hpp"

namespace signorini {
namespace {

void check_size(const char* what, std::span<const double> values, std::size_t expected) {
  if (values.size() != expected)
    input_error(what, fmt::format("found {} values, expected {}, one per row of the matrix", values.size(), expected));
}

void check_finite(const char* what, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      input_error(what, fmt::format("found {} in row {}, expected a finite number", values[i], i + 1));
}

void check_near_null(const NearNullSpace& near_null, Index rows, Coarsening coarsening) {
  if (near_null.modes == 0 && near_null.value.empty()) return;
  constexpr const char* what = "near null space";
  if (coarsening == Coarsening::classical)
    input_error(
        what,
        "given with coarsening 'classical', which has no use for it; expected coarsening 'auto' or 'aggregation'");
  if (near_null.modes < 1 || near_null.modes > most_modes)
    input_error(what, fmt::format("found {} modes, expected 1 to {}", near_null.modes, most_modes));
  if (near_null.value.size() != static_cast<std::size_t>(rows) * near_null.modes)
    input_error(what, fmt::format("found {} values, expected {}, for each row of the matrix one per mode",
                                  near_null.value.size(), static_cast<std::size_t>(rows) * near_null.modes));
  check_finite(what, near_null.value);
}

/// A monitor that goes on saying stop once it has said so: it is asked on all levels, one after the other.
Monitor lasting(const Monitor& monitor) {
  if (!monitor) return {};
  return [&monitor, go_on = true](const IterationRecord& record) mutable { return go_on = monitor(record) && go_on; };
}

bool held(const std::vector<Flags>& flags, std::size_t i, int block) {
  return flags[i / static_cast<std::size_t>(block)] >> (i % static_cast<std::size_t>(block)) & 1u;
}

/// The problem of a matrix without load and bounds.
/// @param zero_rows per vector the components whose row is zero
template <int B>
DiscreteProblem<B> problem_of(const SparseRows& A, std::vector<Flags>& zero_rows) {
  DiscreteProblem<B> out;
  out.A = block_matrix<B>(A, &zero_rows);
  const auto n = static_cast<std::size_t>(A.rows);
  for (std::size_t i = 0; i < n; ++i)  // what such a row is to be put back as
    if (held(zero_rows, i, B)) out.A.at(out.A.row[i / B])[i % B * (B + 1)] = 0;
  out.b.assign(n, 0);
  out.start.assign(n, 0);
  return out;
}

}  // namespace

class BlackBox::Solver {
 public:
  /// Levels of another code.
  struct GivenLevels {
    std::span<const SparseRows> interpolations, matrices;
  };
  using Given = std::optional<GivenLevels>;  // none: levels chosen by the matrix

  virtual ~Solver() = default;
  virtual void set_tolerance(double tolerance) = 0;
  virtual void set_matrix(const SparseRows& A) = 0;
  virtual void set_obstacles(std::vector<BlockObstacle<1>>&&) { refuse_obstacles(1); }
  virtual void set_obstacles(std::vector<BlockObstacle<2>>&&) { refuse_obstacles(2); }
  virtual void set_obstacles(std::vector<BlockObstacle<3>>&&) { refuse_obstacles(3); }
  virtual void next_step() { no_step(); }
  virtual Result solve(std::span<const double> b, std::span<const double> lower, std::span<const double> upper,
                       std::span<const double> start, const Monitor& monitor) = 0;

  static std::unique_ptr<Solver> create(const SparseRows& A, const Given& given, int block,
                                        const SolverOptions& options, const NearNullSpace& near_null = {});

 protected:
  virtual std::string accepted_obstacles() const = 0;
  [[noreturn]] static void no_step() {
    input_error("next_step", "found no solution of a solve with obstacles, from which a next step could begin");
  }

 private:
  [[noreturn]] void refuse_obstacles(int block) const {
    input_error("obstacles", fmt::format("given for blocks of {}, expected {}", block, accepted_obstacles()));
  }
};

/// The same in other units of the rows. Bounds that hold are met to the last bit.
class BlackBox::InUnits final : public Solver {
 public:
  /// @param units of A
  InUnits(const SparseRows& A, std::vector<double> units, const SolverOptions& options)
      : units_(std::move(units)), solver_(Solver::create(in_units(checked(A), units_), {}, 1, options)) {}

  void set_tolerance(double tolerance) override { solver_->set_tolerance(tolerance); }
  void set_matrix(const SparseRows& A) override {
    if (A.rows == static_cast<Index>(units_.size())) return solver_->set_matrix(in_units(checked(A), units_));
    solver_->set_matrix(A);  // which says so
  }

  Result solve(std::span<const double> b, std::span<const double> lower, std::span<const double> upper,
               std::span<const double> start, const Monitor& monitor) override {
    check_size("b", b, units_.size());
    const GivenBounds bounds(units_.size(), lower, upper);
    if (!start.empty()) check_size("start", start, units_.size());
    const auto times = [](double value, double unit) { return value * unit; };
    const auto over = [](double value, double unit) { return value / unit; };
    Result result =
        solver_->solve(changed(b, times), changed(lower, over), changed(upper, over), changed(start, over), monitor);
    for (std::size_t i = 0; i < units_.size(); ++i) {
      const auto [low, high] = bounds[i];
      const signed char active = result.active[i];
      result.x[i] = active < 0 ? low : active > 0 ? high : block::clamp(result.x[i] * units_[i], low, high);
      result.multiplier[i] /= units_[i];
    }
    return result;
  }

 protected:
  std::string accepted_obstacles() const override {
    return "none: the unknowns of this matrix are in different units, as its diagonal shows; give a near null space, "
           "such as ones, and they are left as they are";
  }

 private:
  /// What is wrong with it is said in the units that it is given in.
  static const SparseRows& checked(const SparseRows& A) {
    std::vector<Flags> zero_rows;
    (void)block_matrix<1>(A, &zero_rows);
    return A;
  }

  template <class Change>
  std::vector<double> changed(std::span<const double> values, const Change& change) const {
    std::vector<double> out(values.size());
    std::transform(values.begin(), values.end(), units_.begin(), out.begin(), change);
    return out;
  }

  const std::vector<double> units_;
  const std::unique_ptr<Solver> solver_;
};

template <int B>
class BlackBox::BlockSolver final : public Solver {
 public:
  BlockSolver(const SparseRows& A, const Given& given, const SolverOptions& options, NearNullSpace near_null)
      : options_(options), registry_(solver_components()), near_null_(std::move(near_null)), chosen_(!given) {
    problem_ = problem_of<B>(A, zero_rows_);
    check_options(options_);
    check_components(options_, registry_);
    check_near_null(near_null_, A.rows, coarsening_of(options_));
    aggregator_ = registry_.create<Aggregator>("aggregates", options_.aggregates);
    hold(zero_rows_);
    held_.prescribe(problem_);
    motions_.emplace(problem_.A);
    if (given) levels_ = take(*given);
    if (motions_->complete()) return;
    // Levels wait for the bounds, which may hold unknowns, unless the matrix is judged by them.
    if (!levels_) levels_ = levels_for(problem_);
    refuse_indefinite<B>(problem_.A, *levels_);
  }

  void set_tolerance(double tolerance) override {
    SolverOptions changed = options_;
    changed.tolerance = tolerance;
    check_options(changed);
    options_ = std::move(changed);
  }

  void set_matrix(const SparseRows& A) override {
    if (A.rows != problem_.A.size() * B)
      input_error("matrix", fmt::format("found {} rows, expected {} as before", A.rows, problem_.A.size() * B));
    std::vector<Flags> zero_rows, fixed = problem_.fixed;
    DiscreteProblem<B> problem = problem_of<B>(A, zero_rows);
    BlockMatrix<B> given = obstacles_ ? problem.A : BlockMatrix<B>();
    if (obstacles_ && zero_rows == zero_rows_) problem.frames = problem_.frames;
    if (obstacles_ && zero_rows != zero_rows_) fixed.assign(zero_rows.size(), 0);  // those of the last frames
    rotate(problem.A, problem.frames);
    for (std::size_t p = 0; p < fixed.size(); ++p) fixed[p] = (fixed[p] & ~zero_rows_[p]) | zero_rows[p];
    HeldRows<B> held;
    held.hold(problem, std::move(fixed));
    held.prescribe(problem);
    Motions<B> motions(problem.A);
    std::optional<AlgebraicLevels<B>> levels;
    if (levels_)
      levels = galerkin_hierarchy<B>(problem, levels_->prolongations, transfer());
    else if (!motions.complete())
      levels = levels_for(problem);
    if (!motions.complete()) refuse_indefinite<B>(problem.A, *levels);
    problem_ = std::move(problem);
    given_ = std::move(given);
    motions_ = std::move(motions);
    zero_rows_ = std::move(zero_rows);
    held_ = std::move(held);
    levels_ = std::move(levels);
  }

  Result solve(std::span<const double> b, std::span<const double> lower, std::span<const double> upper,
               std::span<const double> start, const Monitor& monitor) override {
    const std::size_t n = problem_.b.size();
    check_size("b", b, n);
    check_finite("b", b);
    problem_.b.assign(b.begin(), b.end());
    const GivenBounds bounds(n, lower, upper);
    check_start(start);
    if (obstacles_)
      place_obstacles(bounds, start);
    else
      place_bounds(bounds, start);
    held_.prescribe(problem_);
    const double begin = seconds();
    if (!motions_) motions_.emplace(problem_.A);
    if (!levels_) levels_ = levels_for(problem_);
    interpolations_.clear();
    const double ready = seconds();
    Result result;
    // What friction or faces hold is not known there.
    fall_ = is_box() ? motions_->fall(problem_.b, problem_.constraints)
                     : typename Motions<B>::Fall{.row = {}, .unclear = {}, .certain = true};
    if (fall_.row || fall_.unclear)
      result = without_solution(start);
    else if (!algebraic_settings(options_).only_twins)
      result = solve(*levels_, b, start, monitor);
    else
      result = solve(galerkin_hierarchy<B>(problem_, levels_->prolongations, transfer(), {.only_twins = true}), b,
                     start, monitor);
    result.summary.setup_seconds += ready - begin;
    if (obstacles_) {
      leave_frames(result, b, bounds);
    } else {
      held_.residual(problem_, result.x.data(), b.data(), result.multiplier.data());
      find_active(result, lower, upper);
    }
    return result;
  }

  using Solver::set_obstacles;
  void set_obstacles(std::vector<BlockObstacle<B>>&& obstacles) override {
    std::optional<BlockObstacles<B>> taken;
    if (!obstacles.empty()) taken.emplace(std::move(obstacles), problem_.A.size());
    if (!obstacles_) {
      problem_.fixed.clear();  // puts the matrix back
      hold(std::vector<Flags>(static_cast<std::size_t>(problem_.A.size()), 0));
      given_ = problem_.A;
    } else if (!taken) {
      turn({});
      given_ = {};
      localised_ = {};
      problem_.segments.clear();
    }
    obstacles_ = std::move(taken);
    before_.reset();
    solved_.clear();
    last_.clear();
  }

  void next_step() override {
    if (solved_.empty()) no_step();
    std::vector<double> u = solved_;
    out_of_frames(problem_.frames, u);
    before_.emplace(Before{std::move(u), OwnNumbers<B>(problem_, localised_.functional, solved_)});
  }

 protected:
  std::string accepted_obstacles() const override { return fmt::format("blocks of {}, as the matrix has", B); }

 private:
  TransferFactory<B> transfer() const {
    return [this] { return registry_.create<Transfer<B>>("transfer", options_.transfer); };
  }

  void check_start(std::span<const double> start) const {
    if (start.empty()) return;
    check_size("start", start, problem_.b.size());
    check_finite("start", start);
  }

  /// Components whose row of the matrix is zero or whose bounds are equal.
  std::vector<Flags> held_by(const GivenBounds& bounds) const {
    std::vector<Flags> out = zero_rows_;
    for (std::size_t i = 0; i < problem_.b.size(); ++i)
      if (bounds[i].lower == bounds[i].upper) out[i / B] |= static_cast<Flags>(1u << (i % B));
    return out;
  }

  struct Before {
    std::vector<double> u;  // global coordinates
    OwnNumbers<B> numbers;
  };

  void place_bounds(const GivenBounds& bounds, std::span<const double> start) {
    hold(held_by(bounds));
    problem_.constraints = constraints<B>(bounds, problem_.fixed);
    for (std::size_t i = 0; i < problem_.b.size(); ++i)
      problem_.start[i] = held(problem_.fixed, i, B) ? prescribed_value(i, bounds[i], start) : 0;
  }

  void place_obstacles(const GivenBounds& bounds, std::span<const double> start) {
    localised_ = obstacles_->localised(bounds, fixes(bounds, start));
    DiscreteProblem<B>& local = localised_.problem;
    check_admissible_sets(*obstacles_, local, std::max(obstacles_->size(), 1.0));
    turn(std::move(local.frames));
    hold(std::move(local.fixed));
    problem_.constraints = std::move(local.constraints);
    problem_.segments = std::move(local.segments);
    problem_.start = std::move(local.start);
    rotate(problem_.b, problem_.frames);
    if (!before_) return;
    std::vector<double> last = before_->u;
    into_frames(problem_.frames, last);
    count_from(last, problem_.constraints);
    rest_where_prescribed(problem_);
    before_->numbers.hand_to(localised_.functional, problem_.constraints);
  }

  /// The unknowns that are prescribed, as directions.
  std::vector<FixedDirections<B>> fixes(const GivenBounds& bounds, std::span<const double> start) const {
    const std::vector<Flags> components = held_by(bounds);
    std::vector<FixedDirections<B>> out;
    for (Index p = 0; p < problem_.A.size(); ++p) {
      if (!components[p]) continue;
      FixedDirections<B>& fixed = out.emplace_back(FixedDirections<B>{.vertex = p});
      for (int k = 0; k < B; ++k) {
        if (!(components[p] >> k & 1u)) continue;
        double axis[B] = {};
        axis[k] = 1;
        const std::size_t i = static_cast<std::size_t>(p) * B + static_cast<std::size_t>(k);
        fixed.add(axis, prescribed_value(i, bounds[i], start), 0);
      }
    }
    return out;
  }

  /// The matrix in other frames; nothing is held any more.
  void turn(Frames<B> frames) {
    const Frames<B>& now = problem_.frames;
    if (frames.slot == now.slot && frames.basis == now.basis && frames.dual == now.dual) return;
    held_ = {};
    problem_.A = given_;
    problem_.fixed.clear();
    problem_.frames = std::move(frames);
    rotate(problem_.A, problem_.frames);
  }

  /// Whether bounds of components are all that holds the solution.
  bool is_box() const { return problem_.constraints.facet.empty() && !has_functional(problem_.segments); }

  /// Levels are for components that are held: where these are others, they have to be made anew.
  void hold(std::vector<Flags> components) {
    if (components == problem_.fixed) return;
    held_.hold(problem_, std::move(components));
    motions_.reset();
    if (levels_ && !chosen_) interpolations_ = std::move(levels_->prolongations);
    levels_.reset();
  }

  AlgebraicLevels<B> levels_for(const DiscreteProblem<B>& problem) const {
    if (!chosen_) return galerkin_hierarchy<B>(problem, interpolations_, transfer());
    return algebraic_hierarchy<B>(problem, transfer(), enough_vectors, algebraic_settings(options_), near_null_,
                                  *aggregator_);
  }

  /// The bound that the load goes to; without load, the admissible value next to the start.
  double prescribed_value(std::size_t i, const Interval& bounds, std::span<const double> start) const {
    if (bounds.lower == bounds.upper) return bounds.lower;
    const double load = problem_.b[i];
    const double value = load > 0   ? bounds.upper
                         : load < 0 ? bounds.lower
                                    : block::clamp(start.empty() ? 0.0 : start[i], bounds.lower, bounds.upper);
    if (!std::isfinite(value))
      throw Error(Exit::no_solution,
                  fmt::format("the energy is unbounded below: row {} of the matrix is zero, and no bound holds its "
                              "load {}",
                              i + 1, load));
    return value;
  }

  AlgebraicLevels<B> take(const GivenLevels& given) const {
    std::vector<Prolongation> levels = given_levels(given.interpolations, problem_.A.size());
    std::vector<BlockMatrix<B>> matrices = given_matrices<B>(problem_.A, problem_.fixed, levels, given.matrices);
    return galerkin_hierarchy<B>(problem_, std::move(levels), transfer(), {}, std::move(matrices));
  }

  /// @param levels for the bounds of the problem
  Result solve(const AlgebraicLevels<B>& levels, std::span<const double> b, std::span<const double> start,
               const Monitor& monitor) {
    problem_.galerkin = levels.matrices;
    Result result;
    std::vector<Stage> dropped;
    std::vector<double> from(start.begin(), start.end());
    if (obstacles_) return solve_with_obstacles(levels, std::move(from), monitor);
    if (from == last_) go_on(problem_, way_, from);
    if (start.empty())
      result.x = nested_start<B>(problem_, levels.prolongations, options_, registry_, monitor, &dropped);
    else
      result.x = nested_start_from<B>(from, problem_, levels.prolongations, options_, registry_, monitor, &dropped);
    result.summary = signorini::solve<B>(problem_, levels.prolongations, result.x, options_, registry_, monitor);
    result.summary.put_in_front(std::move(dropped));
    if (!motions_->complete() && is_in_doubt(levels, result.summary)) refuse_indefinite_by_steps<B>(problem_.A);
    if (fall_.certain && result.summary.outcome == Outcome::unbounded)
      go_on_without_motions(levels, result, monitor);
    else if (!fall_.certain && result.summary.outcome != Outcome::interrupted)
      recognise_unbounded(levels, result, monitor);
    refine<B>(problem_, held_, b, options_, *motions_, result.x, result.summary);
    remember(start, result);
    add_multiplier(result);
    return result;
  }

  Result solve_with_obstacles(const AlgebraicLevels<B>& levels, std::vector<double> start, const Monitor& monitor) {
    Result result;
    std::vector<Stage> dropped;
    if (!start.empty()) into_frames(problem_.frames, start);
    result.x = start.empty() ? nested_start<B>(problem_, levels.prolongations, options_, registry_, monitor, &dropped)
                             : std::move(start);
    const std::vector<Index>& acts = localised_.functional;
    probe_functionals(*obstacles_, problem_, acts, result.x);
    try {
      result.summary = signorini::solve<B>(problem_, levels.prolongations, result.x, options_, registry_, monitor);
    } catch (const Error& error) {
      if (error.status() != Exit::interrupted) blame_functionals(*obstacles_, problem_, acts, result.x);
      throw;
    }
    check_functionals(*obstacles_, problem_, acts, result.x);
    result.summary.put_in_front(std::move(dropped));
    if (!fall_.certain && is_box()) recognise_unbounded(levels, result, monitor);
    return result;
  }

  /// The result in the coordinates of the matrix that was given, with what holds it.
  void leave_frames(Result& result, std::span<const double> b, const GivenBounds& bounds) {
    solved_ = result.x;
    result.touching = obstacles_->touched(problem_.constraints, localised_, result.x);
    out_of_frames(problem_.frames, result.x);
    const double rounding = rounding_of_differences * max_norm(result.x);
    result.multiplier.assign(b.size(), 0);
    residual<B>(given_, result.x.data(), b.data(), result.multiplier.data());
    result.active.assign(b.size(), 0);
    for (std::size_t i = 0; i < b.size(); ++i) {
      double& force = result.multiplier[i] *= -1;
      const auto p = static_cast<Index>(i / B);
      const double off = problem_.frames.at(p) ? rounding : 0;
      const bool at_lower = result.x[i] <= bounds[i].lower + off, at_upper = result.x[i] >= bounds[i].upper - off;
      if (at_lower || at_upper) result.active[i] = at_lower && !(at_upper && force < 0) ? -1 : 1;
      result.x[i] = at_lower ? bounds[i].lower : at_upper ? bounds[i].upper : result.x[i];
      const bool pushes = (at_lower && force > 0) || (at_upper && force < 0);
      if (!pushes && !obstacles_->acts_on(p)) force = 0;
    }
  }

  /// What the next solve may go on from. A single cycle leaves nothing but the solver's error.
  void remember(std::span<const double> start, const Result& result) {
    last_ = result.x;
    if (!start.empty() && result.summary.iterations <= 1) return;
    way_.clear();
    for (std::size_t i = 0; i < start.size(); ++i) way_.push_back(last_[i] - start[i]);
  }

  /// Whether levels do not show if the energy falls along something smooth: a method that solves linear systems has
  /// solved what cycles could not, or there are no levels. (Of many couplings a search takes longer than the solve.)
  bool is_in_doubt(const AlgebraicLevels<B>& levels, const Summary& summary) const {
    constexpr Offset few_blocks = 60;  // per vector
    const bool alone =
        levels.prolongations.empty() && std::ssize(problem_.A.column) <= few_blocks * Offset{problem_.A.size()};
    const bool went_on = options_.method == "auto" && !summary.stages.back().linear.empty();
    return summary.converged() && (alone || went_on);
  }

  void add_multiplier(Result& result) const {
    result.multiplier.resize(problem_.b.size());
    residual<B>(problem_.A, result.x.data(), problem_.b.data(), result.multiplier.data());
    for (double& force : result.multiplier) force = -force;
  }

  /// The admissible vector next to the start, and why there is no better one.
  Result without_solution(std::span<const double> start) const {
    Result result;
    result.x.assign(start.begin(), start.end());
    result.x.resize(problem_.b.size(), 0);
    into_frames(problem_.frames, result.x);
    make_admissible(problem_, result.x);
    add_multiplier(result);
    if (fall_.row)
      set_unbounded(result.summary, *fall_.row);
    else
      set_unclear(result.summary, *fall_.unclear);
    result.summary.options = options_;
    result.summary.energy = energy(problem_, result.x);
    return result;
  }

  /// Rounding leaves forces between the bounds, and of either sign where a bound is touched without any.
  static void find_active(Result& result, std::span<const double> lower, std::span<const double> upper) {
    result.active.assign(result.x.size(), 0);
    for (std::size_t i = 0; i < result.x.size(); ++i) {
      double& force = result.multiplier[i];
      const bool at_lower = !lower.empty() && result.x[i] <= lower[i],
                 at_upper = !upper.empty() && result.x[i] >= upper[i];
      if (at_lower || at_upper) result.active[i] = at_lower && !(at_upper && force < 0) ? -1 : 1;
      if (!(at_lower && force > 0) && !(at_upper && force < 0)) force = 0;
    }
  }

  /// No motion is known to fall: on a coarse level, rounding may have been taken for one. Sweeps there take nothing for
  /// one.
  void go_on_without_motions(const AlgebraicLevels<B>& levels, Result& result, const Monitor& monitor) {
    const automatic::Attempt& attempt = automatic::attempt(automatic::Kind::sweeps_below);
    SolverOptions sweeps = options_;
    sweeps.coarse = attempt.solver;
    Attempts attempts(std::move(result.summary));
    attempts.run(attempt, automatic::Start::last, [&] {
      Summary further = signorini::solve<B>(problem_, levels.prolongations, result.x, sweeps, registry_, monitor);
      further.reason += ", with sweeps on the coarsest level, where Newton's method met a singular matrix";
      for (IterationRecord& record : further.history) record.iteration += attempts.done().iterations;
      return further;
    });
    result.summary = attempts.result();
  }

  /// Where not all motions are known, iterates that run away show one. Those of methods without a coarse correction
  /// within bounds are slow to: cycles go on from them.
  void recognise_unbounded(const AlgebraicLevels<B>& levels, Result& result, const Monitor& monitor) {
    if (names_a_fall(result.x, result.summary) || result.summary.converged()) return;
    if (result.summary.outcome == Outcome::unbounded) {
      const std::string reason = result.summary.reason;
      go_on_without_motions(levels, result, monitor);
      if (names_a_fall(result.x, result.summary) || result.summary.converged()) return;
      if (result.summary.outcome == Outcome::interrupted) return;
      result.summary.outcome = Outcome::unbounded;
      result.summary.reason = reason;
      return;
    }
    if (options_.method == "auto" || options_.method == "monotone") return;
    const automatic::Attempt& attempt = automatic::attempt(automatic::Kind::cycles_away);
    SolverOptions cycles = options_;
    cycles.method = attempt.method;
    cycles.max_iterations = attempt.most_steps;
    struct {
      std::vector<double>& x;
      std::vector<double> before = {};
      void save() { before = x; }
      void restore() { x.swap(before); }
    } place{result.x};
    Attempts attempts(std::move(result.summary));
    Summary seen;
    attempts.run(attempt, automatic::Start::last, place, [&] {
      Summary found = signorini::solve<B>(problem_, levels.prolongations, result.x, cycles, registry_, monitor);
      if (found.outcome == Outcome::interrupted || names_a_fall(result.x, found) || found.outcome == Outcome::unbounded)
        seen = found;
      return found;
    });
    result.summary = attempts.result();
    if (!seen.reason.empty()) {
      result.summary.outcome = seen.outcome;
      result.summary.reason = seen.reason;
    }
  }

  bool names_a_fall(const std::vector<double>& x, Summary& summary) const {
    if (!falls_forever(problem_, x)) return false;
    const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
    set_unbounded(summary, std::max_element(x.begin(), x.end(), larger) - x.begin());
    return true;
  }

  static void set_unbounded(Summary& summary, Offset row) {
    summary.outcome = Outcome::unbounded;
    summary.reason = fmt::format(
        "the energy is unbounded below: the load does work along a direction without energy that no bound ends; its "
        "largest entry is in row {}",
        row + 1);
  }

  static void set_unclear(Summary& summary, Offset row) {
    summary.outcome = Outcome::inaccurate;
    summary.algebraic_error = summary.rounding_error = 1;
    summary.reason = fmt::format(
        "rounding hides whether there is a solution: what supports the unknowns coupled to row {} is so weak beside "
        "the couplings that the diagonal hardly shows it",
        row + 1);
  }

  SolverOptions options_;
  Registry registry_;
  DiscreteProblem<B> problem_;
  std::vector<Flags> zero_rows_;  // per vector
  HeldRows<B> held_;
  std::optional<Motions<B>> motions_;  // with the components that are held; none: to be found
  typename Motions<B>::Fall fall_;     // of the problem at hand
  std::vector<double> last_, way_;     // the last solution, and the way there from its start
  NearNullSpace near_null_;
  std::unique_ptr<Aggregator> aggregator_;
  bool chosen_;                               // levels by the matrix
  std::optional<AlgebraicLevels<B>> levels_;  // for the components that are held; none: to be made
  std::vector<Prolongation> interpolations_;  // given ones, while they have no levels

  std::optional<BlockObstacles<B>> obstacles_;  // nothing: bounds alone
  BlockMatrix<B> given_;                        // with obstacles: the matrix without frames
  LocalisedProblem<B> localised_;               // of the last solve with them, but for what is in the problem now
  std::optional<Before> before_;                // the end of the last load step; nothing: none
  std::vector<double> solved_;                  // the last solution with them, in local coordinates
};

std::unique_ptr<BlackBox::Solver> BlackBox::Solver::create(const SparseRows& A, const Given& given, int block,
                                                           const SolverOptions& options,
                                                           const NearNullSpace& near_null) {
  switch (block) {
    case 1:
      return std::make_unique<BlockSolver<1>>(A, given, options, near_null);
    case 2:
      return std::make_unique<BlockSolver<2>>(A, given, options, near_null);
    case 3:
      return std::make_unique<BlockSolver<3>>(A, given, options, near_null);
    default:
      input_error("block", fmt::format("found {}, expected 1, 2 or 3 unknowns in a block", block));
  }
}

BlackBox::BlackBox(const SparseRows& A, int block, const SolverOptions& options, const NearNullSpace& near_null) {
  if (block == 0) block = recognised_block(A);
  std::vector<double> units;
  if (block == 1 && near_null.modes == 0 && near_null.value.empty()) units = recognised_units(A);
  if (units.empty())
    solver_ = Solver::create(A, {}, block, options, near_null);
  else
    solver_ = std::make_unique<InUnits>(A, std::move(units), options);
}

BlackBox::BlackBox(const SparseRows& A, std::span<const SparseRows> interpolations, int block,
                   const SolverOptions& options, std::span<const SparseRows> coarse_matrices)
    : solver_(Solver::create(A, Solver::GivenLevels{interpolations, coarse_matrices}, block, options)) {}

BlackBox::~BlackBox() = default;
BlackBox::BlackBox(BlackBox&&) noexcept = default;
BlackBox& BlackBox::operator=(BlackBox&&) noexcept = default;

void BlackBox::set_tolerance(double tolerance) { solver_->set_tolerance(tolerance); }

BlackBox::Result BlackBox::solve(const Values& b, const Values& lower, const Values& upper, const Values& start,
                                 const Monitor& monitor) {
  return solver_->solve(b, lower, upper, start, lasting(monitor));
}

void BlackBox::set_matrix(const SparseRows& A) { solver_->set_matrix(A); }

template <int B>
void BlackBox::set_obstacles(std::vector<BlockObstacle<B>> obstacles) {
  solver_->set_obstacles(std::move(obstacles));
}

void BlackBox::next_step() { solver_->next_step(); }

template void BlackBox::set_obstacles(std::vector<BlockObstacle<1>>);
template void BlackBox::set_obstacles(std::vector<BlockObstacle<2>>);
template void BlackBox::set_obstacles(std::vector<BlockObstacle<3>>);

}  // namespace signorini
