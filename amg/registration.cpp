#include "amg/registration.hpp"

#include "amg/coarse/coarse_newton.hpp"
#include "amg/coarsening/metis_aggregates.hpp"
#include "amg/linear/amg_cg.hpp"
#include "amg/linear/cholmod_solver.hpp"
#include "smoothers/registration.hpp"
#include "transfer/registration.hpp"

namespace signorini {

void register_coarse_solvers(Registry& registry) {
  const std::string file = file_of(reinterpret_cast<const void*>(&register_coarse_solvers));
  registry.add<CoarseSolver<1>, CoarseSolver<2>, CoarseSolver<3>>(
      {"coarse",
       "newton",
       "projected Gauss-Seidel and Newton steps on the free components, by Cholesky-preconditioned conjugate gradients",
       {},
       file,
       {}},
      [] { return std::make_unique<CoarseNewton<1>>(); }, [] { return std::make_unique<CoarseNewton<2>>(); },
      [] { return std::make_unique<CoarseNewton<3>>(); });
  registry.add<CoarseSolver<1>, CoarseSolver<2>, CoarseSolver<3>>(
      {"coarse", "pgs", "projected symmetric Gauss-Seidel alone", {}, file, {}},
      [] { return std::make_unique<CoarseGaussSeidel<1>>(); }, [] { return std::make_unique<CoarseGaussSeidel<2>>(); },
      [] { return std::make_unique<CoarseGaussSeidel<3>>(); });
}

void register_linear_solvers(Registry& registry) {
  const std::string file = file_of(reinterpret_cast<const void*>(&register_linear_solvers));
  registry.add<LinearSolver>(
      {"linear", "cholmod", "supernodal Cholesky factorisation, for method \"pdas\"", {}, file, {}}, cholmod_solver);
  registry.add<UnsymmetricSolver>(
      {"unsymmetric", "umfpack", "unsymmetric multifrontal factorisation, for method \"newton\"", {}, file, {}},
      umfpack_solver);
  registry.add<LinearSolver>({"linear",
                              "amg_cg",
                              "conjugate gradients with an algebraic multigrid cycle, for active sets of scalar "
                              "problems where cycles are slow",
                              {},
                              file,
                              {}},
                             [] { return std::make_unique<AmgConjugateGradients>(solver_components); });
}

void register_aggregators(Registry& registry) {
  const std::string file = file_of(reinterpret_cast<const void*>(&register_aggregators));
  registry.add<Aggregator>({"aggregates", "greedy", "a vector with all its strong couplings", {}, file, {}},
                           [] { return std::make_unique<GreedyAggregator>(); });
  registry.add<Aggregator>(
      {"aggregates", "metis", "parts of the graph of strong couplings, cut by METIS", {}, file, {}},
      [] { return std::make_unique<MetisAggregator>(); });
}

Registry solver_components() {
  Registry registry;
  register_smoothers(registry);
  register_transfers(registry);
  register_coarse_solvers(registry);
  register_linear_solvers(registry);
  register_aggregators(registry);
  return registry;
}

}  // namespace signorini
