#include "amg/direct.hpp"

#include "core/component/companion.hpp"

namespace signorini {

std::unique_ptr<DirectSolver> cholmod_solver() {
  using Create = DirectSolver* (*)();
  static const auto create = reinterpret_cast<Create>(
      load_function(core_folder() / "libsignorini_cholmod.so", "signorini_direct_solver", "the direct solver"));
  return std::unique_ptr<DirectSolver>(create());
}

}  // namespace signorini
