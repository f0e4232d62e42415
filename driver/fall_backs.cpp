#include <algorithm>
#include <memory>
#include <utility>

#include "core/solver/local_coordinates.hpp"
#include "driver/nested_solver.hpp"
#include "methods/attempts.hpp"
#include "methods/newton.hpp"

// The attempts of a NestedSolver at one load step (methods/stages.hpp).

namespace signorini {
namespace {

using automatic::Kind;
using automatic::Start;

/// Solutions are large: the one that may be gone back to is moved.
template <int B>
struct Reversible {
  Solution<B> now, before = {};
  void save() { before = std::move(now); }
  void restore() { now = std::move(before); }
};

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
std::unique_ptr<NestedSolver<D, B>> NestedSolver<D, B>::other_way(Kind kind) const {
  Scene::Solver own = options_;
  if (kind == Kind::levels_of_meshes) {
    own.hierarchy = "meshes";
  } else {
    own.method = "newton";
    own.start = "nested";
    own.max_iterations = std::min(own.max_iterations, automatic::attempt(kind).most_steps);
  }
  auto other = std::make_unique<NestedSolver>(hierarchy_, own, registry_, progress_, times_, nodes_);
  other->spared_ = spared_;
  if (pairs_.given()) other->take_contact(pairs_.all(), forces_);
  other->before_ = before_;
  other->pairs_.come_after(pairs_);
  return other;
}

template <int D, int B>
Solution<B> NestedSolver<D, B>::solve_safely(const Model<B>& model) {
  Attempts attempts;
  Reversible<B> place;
  const auto run = [&](Kind kind, const auto& solve) {
    return attempts.run(automatic::attempt(kind), Start::first, place, [&] {
      place.now = solve();
      return std::move(place.now.summary);
    });
  };
  const auto try_other = [&](Kind kind, const char* phase) {
    progress_.phase(phase);
    auto other = other_way(kind);
    const auto& last = before_.back().u;
    if (run(kind, [&] { return last.empty() ? other->solve(model) : other->solve_after(model, last); }))
      other_ = std::move(other);
  };
  if (may_fall_back()) {
    run(Kind::levels_of_matrix, [&] { return start_and_solve(model); });
    if (!attempts.begun() || (attempts.done().outcome != Outcome::converged && !progress_.is_ended()))
      try_other(Kind::levels_of_meshes,
                "levels chosen by the matrix do not reach the tolerance: once more with those of the meshes");
  } else {
    place.now = start_and_solve(model);
    if (progress_.is_ended() || !newton_may_do(place.now)) return std::move(place.now);
    attempts = Attempts(std::move(place.now.summary));
    try_other(Kind::newton_by_meshes, "friction does not come to rest: once more by Newton's method");
  }
  place.now.summary = attempts.result();
  return std::move(place.now);
}

/// Newton's method is for the step at hand: the next one is tried by cycles again.
template <int D, int B>
void NestedSolver<D, B>::come_back() {
  if (!other_ || other_->options_.method == options_.method) return;
  before_ = std::move(other_->before_);
  pairs_.come_after(other_->pairs_);
  other_.reset();
}

template <int D, int B>
Solution<B> NestedSolver<D, B>::solve_after(const Model<B>& model, const std::vector<double>& u) {
  come_back();
  if (other_) return other_->solve_after(model, u);
  before_.back().u = u;
  pairs_.begin_step(model, u);
  Solution<B> solution = solve_safely(model);
  Attempts attempts(std::move(solution.summary));
  const auto displacement = [&] { return to_global(solution.discretization.problem, solution.x); };
  const auto may_slide = [&] { return !other_ && attempts.done().converged(); };  // the other one follows by itself
  for (int again = 0; again < automatic::most_slides && may_slide() && !progress_.is_ended(); ++again) {
    if (!pairs_.follow(model, displacement())) break;
    progress_.phase("bodies have slid past each other, and are paired anew");
    attempts.run(automatic::attempt(Kind::pairs_anew), Start::first, [&] {
      solution = solve_safely(model);
      return std::move(solution.summary);
    });
  }
  if (!other_) solution.slides_on = may_slide() && pairs_.would_follow(model, displacement());
  solution.summary = attempts.result();
  return solution;
}

#define SIGNORINI_INSTANTIATE(D, B)                                       \
  template bool NestedSolver<D, B>::may_fall_back() const;                \
  template Solution<B> NestedSolver<D, B>::solve_safely(const Model<B>&); \
  template void NestedSolver<D, B>::come_back();                          \
  template Solution<B> NestedSolver<D, B>::solve_after(const Model<B>&, const std::vector<double>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
