#pragma once
#include <span>
#include <string>

#include "core/solver/options.hpp"

namespace signorini {

/// The options that texts "method=tnnmg", "max_iterations=50"... set, the others as they are by default. It needs
/// nothing that reads scenes; solver_options() in core/scene is for the command line.
/// @throws Error(Exit::input) "solver.KEY=VALUE: ..." for unknown keys, and values of another type or out of range
SolverOptions options_from_text(std::span<const std::string> assignments);

}  // namespace signorini
