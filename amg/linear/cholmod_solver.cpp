#include "amg/linear/cholmod_solver.hpp"

#include "core/component/companion.hpp"

namespace signorini {

namespace {

template <class Solver>
std::unique_ptr<Solver> create(const char* function) {
  using Create = Solver* (*)();
  static const auto create = reinterpret_cast<Create>(load_function(direct_solvers, function));
  return std::unique_ptr<Solver>(create());
}

}  // namespace

std::unique_ptr<LinearSolver> cholmod_solver() { return create<LinearSolver>("signorini_linear_solver"); }

std::unique_ptr<UnsymmetricSolver> umfpack_solver() {
  return create<UnsymmetricSolver>("signorini_unsymmetric_solver");
}

}  // namespace signorini
