#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "driver/nested_solver.hpp"
#include "methods/nested_iteration.hpp"
#include "methods/newton.hpp"
#include "methods/stages.hpp"

// What a NestedSolver goes on with where its own way did not do: another one, with other options.

namespace signorini {
namespace {

/// Of Newton's method on each mesh, where cycles do not do.
constexpr int most_newton_steps = 40;

}  // namespace

template <int D, int B>
bool NestedSolver<D, B>::may_fall_back() const {
  return B > 1 && by_matrix() && options_.hierarchy == "auto" && hierarchy_.levels.size() > 1;
}

/// Whether bodies that little but friction holds may be found by Newton's method, which goes up the meshes on its own:
/// starts by few cycles have slid far away.
template <int D, int B>
bool NestedSolver<D, B>::newton_may_do(const Solution<B>& solution) const {
  const Outcome outcome = solution.summary.outcome;
  if (options_.method != "auto" || (outcome != Outcome::stuck && outcome != Outcome::inaccurate)) return false;
  const DiscreteProblem<B>& problem = solution.discretization.problem;
  return NewtonIteration<B>::suits(problem) && automatic::newton_is_affordable(B, std::ssize(problem.b));
}

/// A solver with other options that comes after the same step.
template <int D, int B>
std::unique_ptr<NestedSolver<D, B>> NestedSolver<D, B>::other_way(const Scene::Solver& options) const {
  auto other = std::make_unique<NestedSolver>(hierarchy_, options, registry_, progress_, times_, nodes_);
  other->spared_ = spared_;
  if (pairs_.given()) other->take_contact(pairs_.all(), forces_);
  other->before_ = before_;
  other->pairs_.come_after(pairs_);
  return other;
}

/// Another try where `first` did not do: the better one of both is what goes on. Errors of the other one count where
/// there is no first solution.
template <int D, int B>
Solution<B> NestedSolver<D, B>::try_again(const Model<B>& model, const Scene::Solver& options, std::vector<Stage> left,
                                          std::optional<Solution<B>> first) {
  auto other = other_way(options);
  std::optional<Solution<B>> second;
  const Stopwatch watch;
  try {
    second = before_.back().u.empty() ? other->solve(model) : other->solve_after(model, before_.back().u);
  } catch (const Error& error) {
    if (error.status() == Exit::interrupted || !first) throw;
    first->summary.stages.push_back(dropped_start(watch.elapsed(), error.what()));
    return std::move(*first);
  }
  const bool same_method = options.method == options_.method;  // else what it did not solve is of no use
  const bool better =
      second->summary.outcome == Outcome::converged || !first || (same_method && !first->summary.converged());
  if (better) other_ = std::move(other);
  if (!better) left = second->summary.stages;
  for (Stage& stage : left) stage.kept = false;
  Solution<B>& kept = better ? *second : *first;
  kept.summary.put_in_front(std::move(left));
  return std::move(kept);
}

/// Slender bodies sway with so little energy that rounding in the matrix hides it. Levels by the matrix may then carry
/// them anywhere, and say so at best by missing the tolerance; meshes keep such motions out of the corrections.
template <int D, int B>
Solution<B> NestedSolver<D, B>::solve_on_meshes(const Model<B>& model) {
  std::optional<Solution<B>> first;
  const Stopwatch watch;
  std::vector<Stage> left;
  try {
    first = start_and_solve(model);
    if (first->summary.outcome == Outcome::converged || progress_.is_ended()) return std::move(*first);
    left = first->summary.stages;
  } catch (const Error& error) {
    if (error.status() == Exit::interrupted) throw;
    left = {dropped_start(watch.elapsed(), error.what())};
  }
  progress_.phase("levels chosen by the matrix do not reach the tolerance: once more with those of the meshes");
  Scene::Solver own = options_;
  own.hierarchy = "meshes";
  return try_again(model, own, std::move(left), std::move(first));
}

template <int D, int B>
Solution<B> NestedSolver<D, B>::solve_safely(const Model<B>& model) {
  if (may_fall_back()) return solve_on_meshes(model);
  Solution<B> first = start_and_solve(model);
  if (progress_.is_ended() || !newton_may_do(first)) return first;
  progress_.phase("friction does not come to rest: once more by Newton's method");
  Scene::Solver own = options_;
  own.method = "newton";
  own.start = "nested";
  own.max_iterations = std::min(own.max_iterations, most_newton_steps);
  std::vector<Stage> left = first.summary.stages;
  return try_again(model, own, std::move(left), std::move(first));
}

/// Newton's method is for the step at hand: the next one is tried by cycles again.
template <int D, int B>
void NestedSolver<D, B>::come_back() {
  if (!other_ || other_->options_.method == options_.method) return;
  before_ = std::move(other_->before_);
  pairs_.come_after(other_->pairs_);
  other_.reset();
}

#define SIGNORINI_INSTANTIATE(D, B)                                       \
  template bool NestedSolver<D, B>::may_fall_back() const;                \
  template Solution<B> NestedSolver<D, B>::solve_safely(const Model<B>&); \
  template void NestedSolver<D, B>::come_back();
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
