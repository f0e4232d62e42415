#include "methods/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <new>
#include <utility>

#include "core/algebra/energy_along.hpp"
#include "core/base/clock.hpp"
#include "core/base/error.hpp"
#include "methods/active_set.hpp"
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
    from_zero_ = std::ranges::all_of(x, [](double v) { return v == 0; });
    if (situation_.functional) start_ = now();
  }

  Summary run() {
    for (const automatic::StageRule& rule : automatic::stages())
      if (unsolved_for(rule) && rule.suits(situation_)) run(rule);
    if (went_on_ && done_.outcome == Outcome::stuck) {
      done_.outcome = Outcome::iteration_limit;
      done_.reason = fmt::format("iteration limit {}: {}", options_.max_iterations, done_.reason);
    }
    done_.setup_seconds = setup_seconds_;
    return std::move(done_);
  }

 private:
  bool unsolved_for(const automatic::StageRule& rule) const {
    if (!situation_.begun) return true;
    if (situation_.functional)
      return done_.outcome == Outcome::stuck && !(rule.kind == automatic::Kind::cycles_from_zero && from_zero_);
    if (steps_ >= options_.max_iterations) return false;
    return done_.outcome == Outcome::stuck || (went_on_ && done_.outcome == Outcome::iteration_limit);
  }

  void run(const automatic::StageRule& rule) {
    if (!situation_.begun) return begin(rule);
    went_on_ = !situation_.functional;
    switch (rule.kind) {
      case automatic::Kind::cycles_again:
        return begin_again(rule, start_);
      case automatic::Kind::cycles_from_zero:
        from_zero_ = true;
        return begin_again(rule, zero());
      case automatic::Kind::newton:
        return newton_with_friction(rule);
      case automatic::Kind::cycles:
        return cycle(rule, prolongations_);
      case automatic::Kind::single_level:
        return cycle(rule, {});
      case automatic::Kind::active_sets:
        return attempt<ActiveSetIteration<B>>(rule, rule.solver, automatic::shift_if_singular);
      case automatic::Kind::interior_points:
        return attempt<InteriorPointIteration<B>>(rule, rule.solver);
    }
  }

  void begin(const automatic::StageRule& rule) {
    const double begin = seconds();
    SolverOptions own = options_;
    own.method = rule.method;
    if (rule.kind == automatic::Kind::cycles_again) own.krylov = false;
    own.max_iterations = std::min(own.max_iterations, rule.most_steps);
    const bool longer = situation_.following && rule.patience.first < automatic::patience_with_loads.first;
    MultigridIteration<B> loop(problem_, prolongations_, x_, own, components(rule), situation_,
                               longer ? automatic::patience_with_loads : rule.patience);
    const double ready = seconds();
    done_ = loop.run(monitor_);
    setup_seconds_ = ready - begin;
    steps_ = done_.iterations;
    situation_.begun = true;
    if (done_.outcome == Outcome::iteration_limit && steps_ < options_.max_iterations) done_.outcome = Outcome::stuck;
    situation_.slow = loop.lost_patience();
    situation_.unknowns = done_.level_unknowns.back();
    situation_.coarsest = done_.level_unknowns.front();
  }

  /// Where an iteration begins: x, and p of a load that follows.
  struct Place {
    std::vector<double> x, p;
    bool operator==(const Place&) const = default;
  };
  Place now() const { return {x_, problem_.following ? problem_.following->values() : std::vector<double>{}}; }
  Place zero() const {
    Place out = start_;
    std::ranges::fill(out.x, 0.0);
    std::ranges::fill(out.p, 0.0);
    return out;
  }
  void go_to(const Place& place) {
    x_ = place.x;
    if (problem_.following) problem_.following->set(place.p);
  }

  /// What was done until now is dropped.
  void begin_again(const automatic::StageRule& rule, const Place& start) {
    std::vector<Stage> left = std::move(done_.stages);
    for (Stage& stage : left) stage.kept = false;
    go_to(start);
    begin(rule);
    done_.put_in_front(std::move(left));
  }

  /// From the first start, then from zero: cycles may have slid far away. Then from there, all the same.
  void newton_with_friction(const automatic::StageRule& rule) {
    const Place last = now(), nothing = zero();
    for (const Place* start : std::array<const Place*, 3>{&start_, &nothing, &last}) {
      if (done_.outcome != Outcome::stuck || (start == &start_ && start_ == nothing)) continue;
      go_to(*start);
      attempt<NewtonIteration<B>>(rule);
    }
  }

  /// The user's options for up to `most` further steps.
  SolverOptions limited(int most) const {
    SolverOptions own = options_;
    own.max_iterations = most < options_.max_iterations - steps_ ? steps_ + most : options_.max_iterations;
    return own;
  }

  Components<B> components(const automatic::StageRule& rule) const {
    SolverOptions own = options_;
    if (*rule.solver) own.coarse = rule.solver;
    return components_of<B>(own, registry_);
  }

  Monitor counted() {
    return [this](const IterationRecord& record) {
      ++steps_;
      return !monitor_ || monitor_(record);
    };
  }

  /// A method that solves linear systems: it may fail, its linear solver may not be there, or out of memory. Then what
  /// it did is dropped.
  template <class Method, class... More>
  void attempt(const automatic::StageRule& rule, More... more) {
    const SolverOptions own = limited(rule.most_steps);
    const int before = steps_;
    const Place start = now();
    const double begin = seconds();
    bool ended = false;
    Stage stage;
    stage.method = rule.method;
    stage.linear = rule.solver;
    try {
      Summary found = Method(problem_, x_, own, registry_, more...).run(counted(), steps_);
      found.iterations = found.stages.front().iterations = 0;  // no cycles
      stage = found.stages.front();
      ended = found.converged() || found.outcome == Outcome::interrupted;
      if (ended) done_.append(std::move(found));
    } catch (const Error& error) {
      if (error.status() == Exit::interrupted) throw;
      stage.reason = error.what();
    } catch (const std::bad_alloc&) {
      stage.reason = "out of memory";
    }
    if (ended) {
      if (done_.converged()) refuse_if_indefinite(start.x);
      return;
    }
    stage.seconds = seconds() - begin;
    stage.kept = false;
    done_.stages.push_back(std::move(stage));
    go_to(start);
    steps_ = before;
  }

  /// What such a method calls solved is a minimum only if the matrix has no negative eigenvalue. Else it may lie above
  /// where the cycles came to, and the way there shows that.
  void refuse_if_indefinite(const std::vector<double>& start) const {
    std::vector<double> way(x_.size());
    std::transform(x_.begin(), x_.end(), start.begin(), way.begin(), std::minus<>());
    refuse_if_negative_along(problem_.A, way);
  }

  void cycle(const automatic::StageRule& rule, std::span<const Prolongation> prolongations) {
    SolverOptions own = limited(rule.most_steps);
    own.method = "monotone";
    Summary found = MultigridIteration<B>(problem_, prolongations, x_, own, components(rule)).run(counted(), steps_);
    found.options.method = found.stages.front().method = rule.method;
    if (prolongations.empty()) found.iterations = found.stages.front().iterations = 0;  // no cycles
    done_.append(std::move(found));
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
  Place start_;             // where the first ones began, if others may
  Summary done_;
  double setup_seconds_ = 0;
  int steps_ = 0;  // of all that is kept
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
  if (method == Method::newton) return std::make_unique<NewtonIteration<B>>(problem, x, options, registry);
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
