#include "amg/registration.hpp"

#include "amg/coarse_newton.hpp"
#include "amg/direct.hpp"
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

void register_direct_solvers(Registry& registry) {
  const std::string file = file_of(reinterpret_cast<const void*>(&register_direct_solvers));
  registry.add<DirectSolver>(
      {"direct", "cholmod", "supernodal Cholesky factorisation, for method \"pdas\"", {}, file, {}}, cholmod_solver);
}

Registry solver_components() {
  Registry registry;
  register_smoothers(registry);
  register_transfers(registry);
  register_coarse_solvers(registry);
  register_direct_solvers(registry);
  return registry;
}

}  // namespace signorini
