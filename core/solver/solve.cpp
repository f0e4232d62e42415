#include "core/solver/solve.hpp"

#include <fmt/format.h>

#include <new>
#include <utility>

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
  if (check_options(options) == Method::pdas) {
    if (has_functional(problem.segments))
      input_error("solver.method",
                  "'pdas' treats bounds alone, and an obstacle adds a functional to the energy; "
                  "expected 'auto', 'monotone', 'tnnmg' or 'pgs'");
    return std::make_unique<ActiveSetIteration<B>>(problem, x, options, registry);
  }
  return std::make_unique<MultigridIteration<B>>(problem, prolongations, x, options, registry);
}

/// The methods that "auto" goes on with where cycles are slow, each from where the last one that was kept ended: active
/// sets, with a shift where the matrix is singular on the free components; interior points where sets cycle; where all
/// of them fail there may be no solution, which the coarse solver on the finest level finds out; then more of the
/// cycles.
template <int B>
class Continuation {
 public:
  /// Keeps references to all but `cycles`.
  Continuation(Summary cycles, const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
               std::vector<double>& x, const SolverOptions& options, const Registry& registry, const Monitor& monitor)
      : problem_(problem),
        prolongations_(prolongations),
        x_(x),
        options_(options),
        registry_(registry),
        monitor_(monitor),
        done_(std::move(cycles)),
        steps_(done_.iterations) {}

  Summary run() {
    const Offset unknowns = done_.level_unknowns.back();
    const bool small = unknowns <= automatic::most_unknowns_where_sets_cycle;
    const std::vector<std::string> solvers =
        automatic::solvers_for_active_sets(B, unknowns, done_.level_unknowns.front());
    for (const std::string& linear : solvers)
      if (attempt<ActiveSetIteration<B>>("pdas", linear, options_.max_iterations, automatic::shift_if_singular))
        return std::move(done_);
    if (small && attempt<InteriorPointIteration<B>>("interior_point", solvers.back(), automatic::most_interior_points))
      return std::move(done_);
    if (problem_.A.size() * B <= automatic::most_unknowns_for_newton && !prolongations_.empty())
      cycle("newton", {}, automatic::newton_steps);
    if (done_.outcome == Outcome::stuck || done_.outcome == Outcome::iteration_limit)
      cycle("monotone", prolongations_, options_.max_iterations);
    if (done_.outcome == Outcome::stuck) {
      done_.outcome = Outcome::iteration_limit;
      done_.reason = fmt::format("iteration limit {}: {}", options_.max_iterations, done_.reason);
    }
    return std::move(done_);
  }

 private:
  /// The user's options for up to `most` further steps.
  SolverOptions limited(int most) const {
    SolverOptions own = options_;
    own.max_iterations = most < options_.max_iterations - steps_ ? steps_ + most : options_.max_iterations;
    return own;
  }

  Monitor counted() {
    return [this](const IterationRecord& record) {
      ++steps_;
      return !monitor_ || monitor_(record);
    };
  }

  /// A method that solves linear systems: it may fail, its linear solver may not be there, or out of memory. Then what
  /// it did is dropped. Returns whether the solve is over.
  template <class Method, class... More>
  bool attempt(const std::string& method, const std::string& linear, int most, More... more) {
    if (steps_ >= options_.max_iterations) return false;
    const SolverOptions own = limited(most);
    const int before = steps_;
    const std::vector<double> start = x_;
    const double begin = seconds();
    Stage stage;
    stage.method = method;
    stage.linear = linear;
    try {
      Summary found = Method(problem_, x_, own, registry_, linear, more...).run(counted(), steps_);
      found.iterations = found.stages.front().iterations = 0;  // no cycles
      if (found.converged() || found.outcome == Outcome::interrupted) {
        done_.append(std::move(found));
        return true;
      }
      stage = std::move(found.stages.front());
    } catch (const Error& error) {
      if (error.status() == Exit::interrupted) throw;
      stage.reason = error.what();
    } catch (const std::bad_alloc&) {
      stage.reason = "out of memory";
    }
    stage.seconds = seconds() - begin;
    stage.kept = false;
    done_.stages.push_back(std::move(stage));
    x_ = start;
    steps_ = before;
    return false;
  }

  void cycle(const char* method, std::span<const Prolongation> prolongations, int most) {
    if (steps_ >= options_.max_iterations) return;
    SolverOptions own = limited(most);
    own.method = "monotone";
    Summary found = MultigridIteration<B>(problem_, prolongations, x_, own, registry_).run(counted(), steps_);
    found.options.method = found.stages.front().method = method;
    if (prolongations.empty()) found.iterations = found.stages.front().iterations = 0;  // no cycles
    done_.append(std::move(found));
  }

  const DiscreteProblem<B>& problem_;
  std::span<const Prolongation> prolongations_;
  std::vector<double>& x_;
  const SolverOptions& options_;
  const Registry& registry_;
  const Monitor& monitor_;
  Summary done_;
  int steps_;  // of all that is kept
};

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
    summary = Continuation<B>(std::move(summary), problem, prolongations, x, options, registry, monitor).run();
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
