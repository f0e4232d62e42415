#include "methods/automatic.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "methods/stages.hpp"

namespace signorini::automatic {

namespace {

bool interior_points_suit(Offset unknowns) {
  return std::ranges::any_of(stages(), [=](const Attempt& rule) {
    return rule.kind == Kind::interior_points && rule.suits({.unknowns = unknowns});
  });
}

}  // namespace

bool may_turn(const SolverOptions& options) { return options.truncate != "none"; }

std::string describe(const SolverOptions& options, bool aggregates, int block, Offset unknowns, bool functional) {
  std::string text = "monotone";
  if (may_turn(options) && aggregates)
    text += ", tnnmg from the second cycle on while it gains more than cycles with bounds";
  else if (may_turn(options))
    text += fmt::format(", tnnmg while at most {} % of the phases change, and in every second cycle after {}",
                        resting_percent, patience_with_bounds);
  if (const auto solvers = solvers_for_active_sets(block, unknowns, 0); !solvers.empty() && !functional)
    text += fmt::format("; pdas with {} after {} cycles or more, where they would be over {}{}",
                        fmt::join(solvers, ", else "), patience_with_cycles.first,
                        std::min(patience_with_cycles.most, options.max_iterations),
                        interior_points_suit(unknowns) ? "; then interior points" : "");
  return text;
}

}  // namespace signorini::automatic
