#include "methods/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "core/algebra/energy_along.hpp"
#include "core/base/clock.hpp"
#include "core/base/error.hpp"
#include "methods/active_set.hpp"
#include "methods/attempts.hpp"
#include "methods/automatic.hpp"
#include "methods/configuration.hpp"
#include "methods/interior_point.hpp"
#include "methods/multigrid_iteration.hpp"
#include "methods/newton.hpp"
#include "methods/stages.hpp"

namespace signorini {

namespace {

/// The stages of method "auto" for one problem.
template <int B>
class Automatic {
 public:
  /// Keeps references to all.
  Automatic(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations, std::vector<double>& x,
            const SolverOptions& options, const Registry& registry, const Monitor& monitor)
      : problem_(problem),
        prolongations_(prolongations),
        x_(x),
        options_(options),
        registry_(registry),
        monitor_(monitor) {
    situation_.block = B;
    situation_.vectors = problem.A.size();
    situation_.coarsest_vectors = prolongations.empty() ? problem.A.size() : prolongations.front().coarse;
    situation_.couplings = problem.A.row[problem.A.size()];
    situation_.unknowns = Offset{situation_.vectors} * B;
    situation_.coarsest = Offset{situation_.coarsest_vectors} * B;
    situation_.levels = !prolongations.empty();
    situation_.functional = has_functional(problem.segments) || problem.following;
    situation_.friction = NewtonIteration<B>::suits(problem);
    situation_.following = problem.following != nullptr;
    situation_.newton = options.coarse == "newton" && !problem.cheap_to_factorise && !situation_.functional;
    situation_.spent = problem.spent;
    from_zero_ = std::ranges::all_of(x, [](double v) { return v == 0; });
    if (situation_.functional) start_ = now();
  }

  Summary run() {
    for (const automatic::Attempt& attempt : automatic::stages())
      for (const Start start : attempt.starts)
        if (attempt.suits(situation_) && (!attempts_.begun() || (is_unsolved() && !is_repeated(attempt, start))))
          run(attempt, start);
    Summary done = attempts_.result();
    if (went_on_ && done.outcome == Outcome::stuck) {
      done.outcome = Outcome::iteration_limit;
      done.reason = fmt::format("iteration limit {}: {}", options_.max_iterations, done.reason);
    }
    done.setup_seconds = setup_seconds_;
    return done;
  }

  // Places of attempts.
  void save() { before_ = now(); }
  void restore() { go_to(before_); }

 private:
  using Start = automatic::Start;
  using Kind = automatic::Kind;

  bool is_unsolved() const {
    const Outcome outcome = attempts_.done().outcome;
    if (situation_.functional) return outcome == Outcome::stuck;
    if (attempts_.steps() >= options_.max_iterations) return false;
    return outcome == Outcome::stuck || (went_on_ && outcome == Outcome::iteration_limit);
  }

  /// Whether that start was another one's.
  bool is_repeated(const automatic::Attempt& attempt, Start start) const {
    if (attempt.kind == Kind::cycles_from_zero) return from_zero_;
    return attempt.kind == Kind::newton && start == Start::first && start_ == zero();
  }

  void run(const automatic::Attempt& attempt, Start start) {
    went_on_ = attempts_.begun() && !situation_.functional;
    const bool kept = attempts_.run(attempt, start, *this, [&] {
      if (start == Start::first) go_to(start_);
      if (start == Start::zero) go_to(zero());
      return result_of(attempt, start);
    });
    if (kept && attempt.keep == automatic::Keep::solved && attempts_.done().converged()) refuse_if_indefinite();
  }

  Summary result_of(const automatic::Attempt& attempt, Start start) {
    switch (attempt.kind) {
      case Kind::newton:
        return steps_of<NewtonIteration<B>>(attempt, prolongations_);
      case Kind::active_sets:
        return steps_of<ActiveSetIteration<B>>(attempt, attempt.solver, automatic::shift_if_singular);
      case Kind::interior_points:
        return steps_of<InteriorPointIteration<B>>(attempt, attempt.solver);
      case Kind::single_level:
        return without_cycles(more_cycles(attempt, {}));
      default:
        return attempts_.begun() && start == Start::last ? more_cycles(attempt, prolongations_) : first_cycles(attempt);
    }
  }

  Summary first_cycles(const automatic::Attempt& attempt) {
    const double begin = seconds();
    SolverOptions own = options_;
    own.method = attempt.method;
    if (attempt.kind == Kind::cycles_again) own.krylov = false;
    own.max_iterations = std::min(own.max_iterations, attempt.most_steps);
    const bool longer = situation_.following && attempt.patience.first < automatic::patience_with_loads.first;
    MultigridIteration<B> loop(problem_, prolongations_, x_, own, components(attempt), situation_,
                               longer ? automatic::patience_with_loads : attempt.patience);
    setup_seconds_ = seconds() - begin;
    Summary found = loop.run(monitor_);
    situation_.begun = true;
    if (found.outcome == Outcome::iteration_limit && found.iterations < options_.max_iterations)
      found.outcome = Outcome::stuck;
    situation_.slow = loop.lost_patience();
    situation_.unknowns = found.level_unknowns.back();
    situation_.coarsest = found.level_unknowns.front();
    return found;
  }

  /// Where an iteration begins: x, and p of a load that follows.
  struct Place {
    std::vector<double> x, p;
    bool operator==(const Place&) const = default;
  };
  Place now() const { return {x_, problem_.following ? problem_.following->values() : std::vector<double>{}}; }
  Place zero() const { return {std::vector<double>(start_.x.size()), std::vector<double>(start_.p.size())}; }
  void go_to(const Place& place) {
    x_ = place.x;
    if (problem_.following) problem_.following->set(place.p);
  }

  /// The user's options for up to so many further steps as the attempt may take.
  SolverOptions limited(const automatic::Attempt& attempt) const {
    SolverOptions own = options_;
    const int done = attempts_.steps();
    if (attempt.most_steps < own.max_iterations - done) own.max_iterations = done + attempt.most_steps;
    return own;
  }

  Components<B> components(const automatic::Attempt& attempt) const {
    SolverOptions own = options_;
    if (*attempt.solver) own.coarse = attempt.solver;
    return components_of<B>(own, registry_);
  }

  static Summary without_cycles(Summary found) {
    found.iterations = found.stages.front().iterations = 0;
    return found;
  }

  /// Of a method that solves linear systems: it may fail, its linear solver may not be there, or out of memory.
  template <class Method, class... More>
  Summary steps_of(const automatic::Attempt& attempt, More... more) {
    const double begin = seconds();
    Summary found = Method(problem_, x_, limited(attempt), registry_, more...).run(monitor_, attempts_.steps());
    found.stages.front().seconds = seconds() - begin;
    return without_cycles(std::move(found));
  }

  /// What such a method calls solved is a minimum only if the matrix has no negative eigenvalue. Else it may lie above
  /// where the cycles came to, and the way there shows that.
  void refuse_if_indefinite() const {
    std::vector<double> way(x_.size());
    std::transform(x_.begin(), x_.end(), before_.x.begin(), way.begin(), std::minus<>());
    refuse_if_negative_along(problem_.A, way);
  }

  Summary more_cycles(const automatic::Attempt& attempt, std::span<const Prolongation> prolongations) const {
    SolverOptions own = limited(attempt);
    own.method = "monotone";
    Summary found =
        MultigridIteration<B>(problem_, prolongations, x_, own, components(attempt)).run(monitor_, attempts_.steps());
    found.options.method = found.stages.front().method = attempt.method;
    return found;
  }

  const DiscreteProblem<B>& problem_;
  std::span<const Prolongation> prolongations_;
  std::vector<double>& x_;
  const SolverOptions& options_;
  const Registry& registry_;
  const Monitor& monitor_;
  automatic::Situation situation_;
  bool went_on_ = false;    // beyond the first cycles
  bool from_zero_ = false;  // the cycles began there
  Place start_, before_;    // where the first ones began, if others may, and where the attempt at hand did
  Attempts attempts_;
  double setup_seconds_ = 0;
};

/// The loop of a method other than "auto".
template <int B>
std::unique_ptr<Iteration<B>> iteration(Method method, const DiscreteProblem<B>& problem,
                                        std::span<const Prolongation> prolongations, std::vector<double>& x,
                                        const SolverOptions& options, const Registry& registry) {
  check_method(problem, options);
  if (problem.following && method == Method::pdas)
    input_error("solver.method",
                "'pdas' solves for displacements alone, and nearly incompressible material has pressures of its own; "
                "expected 'auto', 'monotone', 'tnnmg' or 'newton', or pressure = \"none\" in the body");
  if (method == Method::pdas) return std::make_unique<ActiveSetIteration<B>>(problem, x, options, registry);
  if (method == Method::newton)
    return std::make_unique<NewtonIteration<B>>(problem, x, options, registry, prolongations);
  SolverOptions own = options;
  if (method == Method::pgs) {  // what is left without coarser levels
    own.coarse = "pgs";
    prolongations = {};
  }
  return std::make_unique<MultigridIteration<B>>(problem, prolongations, x, options, components_of<B>(own, registry));
}

}  // namespace

template <int B>
void check_method(const DiscreteProblem<B>& problem, const SolverOptions& options) {
  const Method method = check_options(options);
  if (method == Method::pdas && has_functional(problem.segments))
    input_error("solver.method",
                "'pdas' treats bounds alone, and an obstacle adds friction or another energy of its own; "
                "expected 'auto', 'monotone', 'tnnmg' or 'pgs', or 'newton' for friction");
  if (method == Method::newton) NewtonIteration<B>::check(problem);
}

template void check_method(const DiscreteProblem<1>&, const SolverOptions&);
template void check_method(const DiscreteProblem<2>&, const SolverOptions&);
template void check_method(const DiscreteProblem<3>&, const SolverOptions&);

template <int B>
Summary solve(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations, std::vector<double>& x,
              const SolverOptions& options, const Registry& registry, const Monitor& monitor) {
  const Method method = check_options(options);
  const double begin = seconds();
  Summary summary;
  if (method == Method::automatic) {
    summary = Automatic<B>(problem, prolongations, x, options, registry, monitor).run();
  } else {
    const auto loop = iteration<B>(method, problem, prolongations, x, options, registry);
    const double ready = seconds();
    summary = loop->run(monitor);
    summary.setup_seconds = ready - begin;
  }
  summary.solve_seconds = seconds() - begin - summary.setup_seconds;
  return summary;
}

template Summary solve(const DiscreteProblem<1>&, std::span<const Prolongation>, std::vector<double>&,
                       const SolverOptions&, const Registry&, const Monitor&);
template Summary solve(const DiscreteProblem<2>&, std::span<const Prolongation>, std::vector<double>&,
                       const SolverOptions&, const Registry&, const Monitor&);
template Summary solve(const DiscreteProblem<3>&, std::span<const Prolongation>, std::vector<double>&,
                       const SolverOptions&, const Registry&, const Monitor&);

}  // namespace signorini
