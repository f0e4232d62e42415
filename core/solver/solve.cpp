#include "core/solver/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <optional>

#include "core/base/clock.hpp"
#include "core/base/error.hpp"
#include "core/solver/active_set.hpp"
#include "core/solver/automatic.hpp"
#include "core/solver/configuration.hpp"
#include "core/solver/interior_point.hpp"
#include "core/solver/multigrid_iteration.hpp"

namespace signorini {

namespace {

template <int B>
std::unique_ptr<Iteration<B>> iteration(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                                        std::vector<double>& x, const SolverOptions& options,
                                        const Registry& registry) {
  if (check_options(options) == Method::pdas)
    return std::make_unique<ActiveSetIteration<B>>(problem, x, options, registry);
  return std::make_unique<MultigridIteration<B>>(problem, prolongations, x, options, registry);
}

// Levels are counted from the coarsest; a method without coarser ones does nothing there.
void add_coarser_levels(const Summary& before, IterationRecord& after) {
  std::vector<LevelReport> idle;
  for (const LevelReport& level : before.history.back().levels) idle.push_back({.vectors = level.vectors});
  if (after.levels.size() < idle.size())
    after.levels.insert(after.levels.begin(), idle.begin(), idle.end() - static_cast<Offset>(after.levels.size()));
}

Summary joined(const Summary& before, Summary after) {
  for (IterationRecord& record : after.history) add_coarser_levels(before, record);
  after.history.insert(after.history.begin(), before.history.begin(), before.history.end());
  after.iterations += before.iterations;
  after.options.method = before.options.method + ", then " + after.options.method;
  after.level_unknowns = before.level_unknowns;
  return after;
}

template <int B>
Summary go_on(const Summary& before, Iteration<B>&& loop, const Monitor& monitor) {
  const auto counted = [&](IterationRecord record) {
    add_coarser_levels(before, record);
    return !monitor || monitor(record);
  };
  return loop.run(counted, before.iterations);
}

// All steps of a method count as one, with what they did in all: the energy may grow between them.
Summary as_one_step(Summary steps, const std::string& what, int before) {
  steps.reason += fmt::format(", after {} {}", steps.iterations, what);
  IterationRecord all = steps.history.back();
  LevelReport& finest = all.levels.back();
  all.changed = finest.changed = finest.renewed = 0;
  finest.seconds = 0;
  for (const IterationRecord& step : steps.history) {
    const LevelReport& level = step.levels.back();
    all.changed = finest.changed += level.changed;
    finest.renewed += level.renewed;
    finest.seconds += level.seconds;
  }
  all.iteration = before + 1;
  steps.history = {all};
  steps.iterations = 1;
  steps.linear_phase_from = 0;
  return steps;
}

// The coarse solver on the finest level, which is monotone and finds motions that nothing holds; where it fails too,
// more of the cycles.
template <int B>
Summary go_on_with_newton(const Summary& cycles, const DiscreteProblem<B>& problem,
                          std::span<const Prolongation> prolongations, std::vector<double>& x,
                          const SolverOptions& options, const Registry& registry, const Monitor& monitor) {
  Summary before = cycles;
  SolverOptions own = options;
  own.method = "monotone";
  if (problem.A.size() * B <= automatic::most_unknowns_where_sets_cycle && !prolongations.empty()) {
    SolverOptions few = own;
    few.max_iterations = std::min(options.max_iterations, cycles.iterations + automatic::newton_steps);
    Summary newton = go_on(cycles, MultigridIteration<B>(problem, {}, x, few, registry), monitor);
    newton.options.method = "newton";
    const bool more = newton.outcome == Outcome::iteration_limit && few.max_iterations < options.max_iterations;
    before = joined(cycles, std::move(newton));
    if (!more) return before;
  }
  return joined(before, go_on(before, MultigridIteration<B>(problem, prolongations, x, own, registry), monitor));
}

/// What a method that solves linear systems makes of an iterate. Nothing where it fails: its linear solver may not be
/// there, or out of memory.
template <class Method, int B, class... More>
std::optional<Summary> go_on_with(const Summary& cycles, const DiscreteProblem<B>& problem, std::vector<double>& x,
                                  const SolverOptions& options, const Registry& registry, const Monitor& monitor,
                                  const std::string& linear, const std::string& steps, More... more) {
  const std::vector<double> start = x;
  try {
    Summary found = go_on(cycles, Method(problem, x, options, registry, linear, more...), monitor);
    if (found.converged())
      return joined(cycles, as_one_step(std::move(found), fmt::format("{} with {}", steps, linear), cycles.iterations));
    if (found.outcome == Outcome::interrupted) return joined(cycles, std::move(found));
  } catch (const Error&) {
  } catch (const std::bad_alloc&) {
  }
  x = start;
  return {};
}

// Where cycles are slow: active sets, with a shift where the matrix is singular on the free components; interior points
// where sets cycle; where all of them fail there may be no solution.
template <int B>
Summary solve_by_linear_systems(const Summary& cycles, const DiscreteProblem<B>& problem,
                                std::span<const Prolongation> prolongations, std::vector<double>& x,
                                const SolverOptions& options, const Registry& registry, const Monitor& monitor) {
  const std::vector<std::string> solvers =
      automatic::solvers_for_active_sets(B, cycles.level_unknowns.back(), cycles.level_unknowns.front());
  SolverOptions own = options;
  own.max_iterations += cycles.iterations;
  for (const std::string& linear : solvers)
    if (auto found = go_on_with<ActiveSetIteration<B>>(cycles, problem, x, own, registry, monitor, linear,
                                                       "active sets", automatic::shift_if_singular))
      return *found;
  own.max_iterations = cycles.iterations + automatic::most_interior_points;
  if (cycles.level_unknowns.back() <= automatic::most_unknowns_where_sets_cycle)
    if (auto found = go_on_with<InteriorPointIteration<B>>(cycles, problem, x, own, registry, monitor, solvers.back(),
                                                           "interior points"))
      return *found;
  return go_on_with_newton(cycles, problem, prolongations, x, options, registry, monitor);
}

}  // namespace

template <int B>
Summary solve(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations, std::vector<double>& x,
              const SolverOptions& options, const Registry& registry, const Monitor& monitor) {
  const double begin = seconds();
  auto loop = iteration(problem, prolongations, x, options, registry);
  const double ready = seconds();
  Summary summary = loop->run(monitor);
  if (summary.outcome == Outcome::stuck && options.method == "auto" && summary.iterations < options.max_iterations) {
    loop.reset();  // its memory is needed
    summary = solve_by_linear_systems(summary, problem, prolongations, x, options, registry, monitor);
  }
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
