#include "amg/linear/cholmod_solver.hpp"

#include "core/component/companion.hpp"

namespace signorini {

std::unique_ptr<LinearSolver> cholmod_solver() {
  using Create = LinearSolver* (*)();
  static const auto create = reinterpret_cast<Create>(
      load_function(core_folder() / "libsignorini_cholmod.so", "signorini_linear_solver", "the direct solver"));
  return std::unique_ptr<LinearSolver>(create());
}

}  // namespace signorini
