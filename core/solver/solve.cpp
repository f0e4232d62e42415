#include "core/solver/solve.hpp"

#include "core/base/clock.hpp"
#include "core/solver/active_set.hpp"
#include "core/solver/configuration.hpp"
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

}  // namespace

template <int B>
Summary solve(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations, std::vector<double>& x,
              const SolverOptions& options, const Registry& registry, const Monitor& monitor) {
  const double begin = seconds();
  const auto loop = iteration(problem, prolongations, x, options, registry);
  const double ready = seconds();
  Summary summary = loop->run(monitor);
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
