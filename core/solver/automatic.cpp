#include "core/solver/automatic.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace signorini::automatic {

bool may_turn(const SolverOptions& options) { return options.truncate != "none"; }

bool begins_with_sweeps(const SolverOptions& options, Index coarsest, Index vectors, Offset couplings) {
  const bool full = couplings > Offset{vectors} * many_couplings;
  const bool costly = (coarsest == vectors && vectors > many_vectors) || (coarsest > fewer_vectors && full);
  return options.method == "auto" && options.coarse == "newton" && costly;
}

std::vector<std::string> solvers_for_active_sets(int block, Offset unknowns, Offset coarsest) {
  std::vector<std::string> out;
  if (block == 1 && 2 * coarsest <= unknowns) out.push_back("amg_cg");
  if (unknowns <= most_unknowns_for_direct) out.push_back("cholmod");
  return out;
}

std::string describe(const SolverOptions& options, bool aggregates, int block, Offset unknowns, bool functional) {
  std::string text = "monotone";
  if (may_turn(options) && aggregates)
    text += ", tnnmg from the second cycle on while it gains more than cycles with bounds";
  else if (may_turn(options))
    text += fmt::format(", tnnmg while at most {} % of the phases change, and in every second cycle after {}",
                        resting_percent, patience_with_bounds);
  if (const auto solvers = solvers_for_active_sets(block, unknowns, 0); !solvers.empty() && !functional)
    text +=
        fmt::format("; pdas with {} after {} cycles or more, where they would be over {}{}",
                    fmt::join(solvers, ", else "), patience_with_cycles, std::min(most_cycles, options.max_iterations),
                    unknowns <= most_unknowns_where_sets_cycle ? "; then interior points" : "");
  return text;
}

}  // namespace signorini::automatic
