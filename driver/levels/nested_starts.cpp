#include <fmt/format.h>

#include <utility>

#include "amg/black_box/nested_start.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solver/interpolate.hpp"
#include "core/solver/local_coordinates.hpp"
#include "core/solver/sticking.hpp"
#include "driver/levels/level_choice.hpp"
#include "driver/levels/level_start.hpp"
#include "driver/levels/nested_solver.hpp"
#include "driver/motions/loose_body.hpp"
#include "methods/attempts.hpp"
#include "methods/near_start.hpp"
#include "methods/nested_iteration.hpp"

// Where solves of a NestedSolver begin: on coarser meshes, and after the last load step.

namespace signorini {

/// For a start on the finest mesh, which alone has to hold the whole problem.
template <int D, int B>
void NestedSolver<D, B>::choose_levels_below(const Model<B>& model) {
  if (factorised_ > 0 || !coarsening_below(options_, B, levels_[first_].nodes.size())) return;
  try {
    Solution<B> coarsest = discretize_level(model, first_);
    continue_algebraically(coarsest.discretization.problem);
  } catch (const Error&) {
    progress_.phase(fmt::format("no levels below the coarsest mesh: {}", failure()));
  }
  matrices_.forget_products();
}

/// On the finest mesh, global coordinates: where bodies would come to if they went on as in the last step. While
/// contact stays the same and loads grow evenly that is the solution. Empty: nothing is known.
template <int D, int B>
std::vector<double> NestedSolver<D, B>::extrapolated(const Model<B>& model) const {
  const LevelSolution<B>& last = levels_.finest().before;
  if (!model.follows || last.u.empty() || options_.start != "nested" || !(last.t > earlier_t_)) return {};
  const double part = (model.t - last.t) / (last.t - earlier_t_);
  std::vector<double> u = last.u;
  for (std::size_t k = 0; k < u.size(); ++k) u[k] += part * (u[k] - (earlier_.empty() ? 0 : earlier_[k]));
  return u;
}

template <int D, int B>
void NestedSolver<D, B>::start_after_step(const Model<B>& model, std::size_t level, const Solution<B>& coarse,
                                          Solution<B>& solution) const {
  const MeshLevel<D, B>& here = levels_[level];
  const DiscreteProblem<B>& problem = solution.discretization.problem;
  std::optional<CoarserStep<B>> coarser;
  if (!coarse.x.empty())
    coarser.emplace(CoarserStep<B>{coarse.discretization.problem, coarse.x, coarse.pressure, levels_[level - 1].before,
                                   matrices_.above(level - 1)});
  const CoarserStep<B>* known = coarser ? &*coarser : nullptr;
  if (here.pressure_space) {
    const auto refined = [&](const std::vector<double>& pressure) { return refined_pressure(level, pressure); };
    start_with_pressure(problem, here.before, known, refined, solution.x, solution.pressure);
  } else {
    std::vector<std::vector<double>> starts;
    if (options_.start == "nested") starts.push_back(std::move(solution.x));
    if (std::vector<double> on = level + 1 == levels_.size() ? extrapolated(model) : std::vector<double>(); !on.empty())
      starts.push_back(to_local(problem, std::move(on)));
    solution.x = start_after(problem, here.before, known, std::move(starts));
  }
}

/// The problem on the finest mesh, with what the last steps lead to if that is so near that no coarser one is asked.
/// Where bodies touch, what slides and nearly incompressible material are always begun on the coarsest mesh.
/// @param solution none: coarser meshes come first in any case
template <int D, int B>
bool NestedSolver<D, B>::begin_near(const Model<B>& model, std::optional<Solution<B>>& solution) {
  const std::size_t finest = levels_.size() - 1;
  const MeshLevel<D, B>& here = levels_[finest];
  if (options_.start != "nested" || here.before.u.empty() || pairs_.given() || changes_unknowns(model)) return false;
  solution = discretize_level(model, finest);
  const DiscreteProblem<B>& problem = solution->discretization.problem;
  if (here.changed || here.pressure_space || !solution->discretization.functional.empty()) return false;
  const auto matrices = matrices_.matrices_below(finest);
  if (matrices.empty()) return false;
  const Stopwatch watch;
  std::vector<std::vector<double>> starts;
  if (std::vector<double> on = extrapolated(model); !on.empty()) starts.push_back(to_local(problem, std::move(on)));
  std::vector<double> x = start_after<B>(problem, here.before, nullptr, std::move(starts));
  const bool near = is_near(problem, matrices_.below(finest), matrices, x);
  if (near) solution->x = std::move(x);
  times_.solve += watch.elapsed();
  return near;
}

/// The start comes from the next coarser mesh, below all meshes from algebraic levels.
/// @param begun what discretize_level() gives, where that is there already
template <int D, int B>
Solution<B> NestedSolver<D, B>::begin_level(const Model<B>& model, std::size_t level, Solution<B>& coarse,
                                            std::optional<Solution<B>> begun) {
  if (!coarse.x.empty()) {
    if (level == first_ + 1) narrow_first(model, coarse);
    pair_near_contact(model, level, coarse);
  }
  connect_jumps(level);
  Solution<B> solution = begun ? std::move(*begun) : discretize_level(model, level);
  DiscreteProblem<B>& problem = solution.discretization.problem;
  const bool refined = !coarse.x.empty(), first = !refined && level == first_ && options_.start == "nested";
  if (first) continue_algebraically(problem);
  const Stopwatch watch;
  if (refined) {
    const Prolongation& P = matrices_.above(level - 1);
    solution.x = interpolate(coarse.discretization.problem, coarse.x, P, problem);
    stick_between(coarse.discretization.problem, coarse.x, P, problem, solution.x);
  }
  if (first) {
    problem.galerkin = matrices_.products_below(level);
    solution.x = nested_start(problem, matrices_.between_algebraic(), options_, registry_, monitor_, &dropped_);
  }
  if (refined) solution.pressure = refined_pressure(level, coarse.pressure);
  if (!levels_[level].before.u.empty()) start_after_step(model, level, coarse, solution);
  times_.solve += watch.elapsed();
  if (refined) {
    const Stopwatch sharing;
    matrices_.share(coarse.discretization.problem, level, problem,
                    levels_[level - 1].changed || levels_[level].changed);
    times_.setup += sharing.elapsed();
    keep(model, levels_[level - 1], coarse);
  }
  return solution;
}

/// The solution on the next coarser mesh than the finest one, as far as that gives a start.
template <int D, int B>
Solution<B> NestedSolver<D, B>::solve_coarser_meshes(const Model<B>& model) {
  Solution<B> coarse;
  const auto solve = [&](std::size_t k, const SolverOptions& options, bool) -> std::string {
    const std::size_t level = first_ + k;
    MeshLevel<D, B>& here = levels_[level];
    Solution<B> solution = begin_level(model, level, coarse);
    std::optional<LooseBody<D, B>> body;
    if (solution.discretization.functional.empty()) body.emplace(here.nodes, model, solution.discretization);
    solve_level(model, level, options, body ? &*body : nullptr, solution);
    here.now.u = to_global(solution.discretization.problem, solution.x);
    here.now.numbers = {solution.discretization.problem, solution.discretization.functional, solution.x};
    here.now.pressure = solution.pressure;
    coarse = std::move(solution);
    return "";
  };
  const auto failed = [&](std::size_t k, Stage stage) {
    stage.reason = fmt::format("level {} gives no start: {}", first_ + k, stage.reason);
    progress_.phase(stage.reason);
    dropped_.push_back(std::move(stage));
    coarse = {};
    matrices_.forget_products();
  };
  nested_iteration<B>(levels_.size() - 1 - first_, options_, solve, failed);
  return coarse;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                \
  template void NestedSolver<D, B>::choose_levels_below(const Model<B>&);                          \
  template bool NestedSolver<D, B>::begin_near(const Model<B>&, std::optional<Solution<B>>&);      \
  template Solution<B> NestedSolver<D, B>::begin_level(const Model<B>&, std::size_t, Solution<B>&, \
                                                       std::optional<Solution<B>>);                \
  template Solution<B> NestedSolver<D, B>::solve_coarser_meshes(const Model<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
