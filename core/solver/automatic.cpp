#include "core/solver/automatic.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace signorini::automatic {

bool may_turn(const SolverOptions& options) { return options.truncate != "none"; }

std::string describe(const SolverOptions& options, bool blocks, Offset unknowns) {
  std::string text = "monotone";
  if (may_turn(options) && blocks)
    text += ", tnnmg from the second cycle on while it gains more than cycles with bounds";
  else if (may_turn(options))
    text += fmt::format(", tnnmg while at most {} % of the phases change, and in every second cycle after {}",
                        resting_percent, patience_with_bounds);
  if (unknowns <= most_unknowns_for_direct)
    text += fmt::format("; pdas after {} cycles or more, where they would be over {}", patience_with_cycles,
                        std::min(most_cycles, options.max_iterations));
  return text;
}

}  // namespace signorini::automatic
