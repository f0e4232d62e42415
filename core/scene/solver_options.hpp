#pragma once
#include <span>
#include <string>

#include "core/solver/options.hpp"

namespace signorini {

/// Options of the solver where there is no scene: from assignments as `--set` takes them, "solver.cycle=W", and else
/// the defaults of `[solver]`.
/// Error(Exit::input) for keys of other tables, unknown ones and those that need meshes, and for a value that is none
/// of the key's.
SolverOptions solver_options(std::span<const std::string> assignments);

}  // namespace signorini
