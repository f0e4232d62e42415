#pragma once
#include <algorithm>
#include <string>

#include "core/base/clock.hpp"
#include "core/base/error.hpp"
#include "core/solver/options.hpp"
#include "core/solver/summary.hpp"
#include "methods/attempts.hpp"

namespace signorini {

/// For a start on a finer level, which need not be better than the discretisation error: one cycle from a coarser start
/// brings a scalar problem below that, as in linear full multigrid; cycles of elastic bodies reduce the error far less.
/// Newton's method is on its way to a solution only near one: it goes on until it has it.
template <int B>
SolverOptions for_a_start(SolverOptions options, bool started) {
  options.tolerance = std::max(options.tolerance, 1e-3);
  constexpr int newton_steps = 40;
  const int most = options.method == "newton" ? newton_steps : B == 1 && started ? 1 : 5;
  options.max_iterations = std::min(options.max_iterations, most);
  return options;
}

/// Nested iteration: levels are solved from the coarsest one up, each from the solution on the one before it. What
/// fails on a coarse level (a part of the boundary without faces there, too few vectors to hold the body) may well hold
/// on the finest one, which alone decides: such a level gives no start, and the next one begins anew.
/// @param levels how many give a start for the finest one, which is none of them
/// @param options of the solve that is to come; the levels are solved less accurately
/// @param solve solve(k, options, started) solves level k, from the solution on the level before where that `started`
/// it; what it returns says why this is no start, and is empty where it is one
/// @param failed failed(k, stage) is told that level k gives none, and the reason
/// @return whether the last one gives a start
/// @throws Error(Exit::interrupted) only, where solve() does
template <int B, class Solve, class Failed>
bool nested_iteration(std::size_t levels, const SolverOptions& options, const Solve& solve, const Failed& failed) {
  bool started = false;
  for (std::size_t k = 0; k < levels; ++k) {
    const double begin = seconds();
    std::string reason;
    try {
      reason = solve(k, for_a_start<B>(options, started), started);
    } catch (const Error&) {
      reason = failure();
    }
    started = reason.empty();
    if (!started)
      failed(k, failed_stage(automatic::attempt(automatic::Kind::nested_start).method, seconds() - begin,
                             std::move(reason)));
  }
  return started;
}

}  // namespace signorini
