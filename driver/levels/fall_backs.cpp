#include <algorithm>
#include <memory>
#include <utility>

#include "core/solver/local_coordinates.hpp"
#include "driver/levels/nested_solver.hpp"
#include "methods/attempts.hpp"
#include "methods/newton.hpp"

// The attempts of a NestedSolver at one load step (methods/stages.hpp).

namespace signorini {
namespace {

using automatic::Kind;
using automatic::Start;

/// Options for a while, or from now on.
class OtherOptions {
 public:
  OtherOptions(Scene::Solver& options, Scene::Solver other)
      : options_(options), own_(std::exchange(options, std::move(other))) {}
  ~OtherOptions() {
    if (!stay_) options_ = std::move(own_);
  }
  void stay() { stay_ = true; }
  OtherOptions(const OtherOptions&) = delete;
  OtherOptions& operator=(const OtherOptions&) = delete;

 private:
  Scene::Solver& options_;
  Scene::Solver own_;
  bool stay_ = false;
};

}  // namespace

/// What an attempt changes but for matrices. Solutions are large: what may be gone back to is moved.
template <int D, int B>
struct NestedSolver<D, B>::Place {
  MeshLevels<D, B>& levels;
  LevelPairs<D, B>& pairs;
  Solution<B> now, before = {};
  typename LevelPairs<D, B>::Found pairs_before = {};
  std::vector<LevelSolution<B>> of_levels = {};

  void save() {
    before = std::move(now);
    pairs_before = pairs.found();
    of_levels.clear();
    for (MeshLevel<D, B>& level : levels) of_levels.push_back(std::exchange(level.now, {}));
  }
  void restore() {
    now = std::move(before);
    pairs.put_back(std::move(pairs_before));
    for (std::size_t k = 0; k < levels.size(); ++k) levels[k].now = std::move(of_levels[k]);
  }
};

/// What a load step came to.
template <int D, int B>
struct NestedSolver<D, B>::Found {
  Solution<B> solution;
  bool otherwise = false;  ///< in another way, which has followed bodies that slide
};

template <int D, int B>
bool NestedSolver<D, B>::may_fall_back() const {
  return B > 1 && by_matrix() && options_.hierarchy == "auto" && levels_.size() > 1;
}

/// Whether bodies that little but friction holds may be found by Newton's method, which goes up the meshes on its own:
/// starts by few cycles have slid far away.
template <int D, int B>
bool NestedSolver<D, B>::newton_may_do(const Solution<B>& solution) const {
  const Outcome outcome = solution.summary.outcome;
  if (options_.method != "auto" || (outcome != Outcome::stuck && outcome != Outcome::inaccurate)) return false;
  const DiscreteProblem<B>& problem = solution.discretization.problem;
  return !problem.spent && NewtonIteration<B>::suits(problem) &&
         automatic::newton_is_affordable(B, std::ssize(problem.b), levels_.size() > 1, problem.following);
}

/// Levels of the meshes are kept for all steps to come; Newton's method is for the step at hand, and the next one is
/// tried by cycles again.
template <int D, int B>
auto NestedSolver<D, B>::solve_safely(const Model<B>& model) -> Found {
  choose_levels();
  Attempts attempts;
  Place place{levels_, pairs_, {}};
  bool otherwise = false;
  const auto run = [&](Kind kind, const auto& solve) {
    return attempts.run(automatic::attempt(kind), Start::first, place, [&] {
      place.now = solve();
      return std::move(place.now.summary);
    });
  };
  const auto try_otherwise = [&](Kind kind, Scene::Solver options, const char* phase) {
    progress_.phase(phase);
    OtherOptions other(options_, std::move(options));
    otherwise = run(kind, [&] {
      pairs_.forget();
      return model.follows ? solve_sliding(model) : solve_safely(model).solution;
    });
    if (otherwise && kind == Kind::levels_of_meshes) other.stay();
  };
  Scene::Solver options = options_;
  if (may_fall_back()) {
    run(Kind::levels_of_matrix, [&] { return start_and_solve(model); });
    if (!attempts.begun() || (attempts.done().outcome != Outcome::converged && !progress_.is_ended())) {
      options.hierarchy = "meshes";
      try_otherwise(Kind::levels_of_meshes, std::move(options),
                    "levels chosen by the matrix do not reach the tolerance: once more with those of the meshes");
      choose_levels();
    }
  } else {
    place.now = start_and_solve(model);
    if (progress_.is_ended() || !newton_may_do(place.now)) return {std::move(place.now)};
    attempts = Attempts(std::move(place.now.summary));
    options.method = "newton";
    options.start = "nested";
    options.max_iterations = std::min(options.max_iterations, automatic::attempt(Kind::newton_by_meshes).most_steps);
    try_otherwise(Kind::newton_by_meshes, std::move(options),
                  "friction does not come to rest: once more by Newton's method");
  }
  place.now.summary = attempts.result();
  return {std::move(place.now), otherwise && model.follows};
}

template <int D, int B>
Solution<B> NestedSolver<D, B>::solve(const Model<B>& model) {
  for (MeshLevel<D, B>& level : levels_) level.before = {};
  return solve_sliding(model);
}

template <int D, int B>
Solution<B> NestedSolver<D, B>::solve_after(const Model<B>& model, const std::vector<double>& u) {
  levels_.finest().before.u = u;
  return solve_sliding(model);
}

/// Steps that follow another one look at bodies where they have come to; others do where follow() is asked for.
template <int D, int B>
Solution<B> NestedSolver<D, B>::solve_sliding(const Model<B>& model) {
  pairs_.begin_step(model, levels_.finest().before.u);
  Found found = solve_safely(pairs_.moved(model));
  if (model.follows) follow_on(model, found);
  return std::move(found.solution);
}

namespace {

constexpr const char* look_there =
    "bodies have moved past each other or an obstacle, and are looked at where they are now";

}  // namespace

/// Contact is linear about where bodies are: where the solution takes them elsewhere they are looked at there.
template <int D, int B>
void NestedSolver<D, B>::follow_on(const Model<B>& model, Found& found) {
  Solution<B>& solution = found.solution;
  Attempts attempts(std::move(solution.summary));
  const auto displacement = [&] { return to_global(solution.discretization.problem, solution.x); };
  const auto may_slide = [&] { return !found.otherwise && attempts.done().converged(); };
  for (int again = 0; again < automatic::most_slides && may_slide() && !progress_.is_ended(); ++again) {
    auto shift = pairs_.shift_after(model, displacement());
    if (shift == pairs_.shift()) break;
    progress_.phase(look_there);
    attempts.run(automatic::attempt(Kind::pairs_anew), Start::first, [&] {
      pairs_.find_about(std::move(shift));
      found = solve_safely(pairs_.moved(model));
      return std::move(solution.summary);
    });
  }
  if (!found.otherwise) solution.slides_on = may_slide() && pairs_.would_follow(model, displacement());
  solution.summary = attempts.result();
}

template <int D, int B>
void NestedSolver<D, B>::follow(const Model<B>& model, double was, const std::function<double(const Solution<B>&)>& off,
                                Solution<B>& solution) {
  constexpr double truer = 0.5;
  auto shift = pairs_.shift_after(model, to_global(solution.discretization.problem, solution.x));
  if (shift == pairs_.shift() || progress_.is_ended()) return;
  progress_.phase(look_there);
  Place place{levels_, pairs_, std::move(solution)};
  Attempts attempts(std::move(place.now.summary));
  attempts.run(automatic::attempt(Kind::pairs_anew_first), Start::first, place, [&] {
    pairs_.find_about(std::move(shift));
    Found found = solve_safely(pairs_.moved(model));
    follow_on(model, found);
    place.now = std::move(found.solution);
    Summary& summary = place.now.summary;
    if (summary.converged() && !(off(place.now) < truer * was)) {
      summary.outcome = Outcome::stuck;
      summary.reason = "contact is no truer about where bodies have come to";
    }
    return std::move(summary);
  });
  solution = std::move(place.now);
  solution.summary = attempts.result();
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                                   \
  template bool NestedSolver<D, B>::may_fall_back() const;                                                            \
  template Solution<B> NestedSolver<D, B>::solve(const Model<B>&);                                                    \
  template Solution<B> NestedSolver<D, B>::solve_after(const Model<B>&, const std::vector<double>&);                  \
  template void NestedSolver<D, B>::follow(const Model<B>&, double, const std::function<double(const Solution<B>&)>&, \
                                           Solution<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
