#pragma once
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/solver/options.hpp"

namespace signorini {

/// The rules of method "auto" (docs/solver.md).
namespace automatic {

/// Cycles after which corrections without bounds take turns while phases change: more than it needs where multigrid
/// does its work.
inline constexpr int patience_with_bounds = 10;
/// Cycles after which active sets are thought of, where there would be more than most_cycles or max_iterations.
inline constexpr int patience_with_cycles = 60, most_cycles = 200;
/// Cycles without Newton steps after which the same is asked of so many.
inline constexpr int patience_with_sweeps = 3, most_sweeping_cycles = 20;
/// Vectors on a single level, and where so many are coupled to each on the coarsest one, above which a cycle's Newton
/// steps, up to a dozen, are too dear to be tried first.
inline constexpr Index many_vectors = 1000, fewer_vectors = 400, many_couplings = 100;
/// What a direct solver does in about a minute and a few gigabytes, even for elasticity in space.
inline constexpr Index most_unknowns_for_direct = 150'000;
/// Of the diagonal, where active sets meet a matrix that is singular on the free components.
inline constexpr double shift_if_singular = 1e-10;
/// Where sets cycle: interior points, for up to so many unknowns and steps, each of which needs a factorisation.
inline constexpr Index most_unknowns_where_sets_cycle = 50'000;
inline constexpr int most_interior_points = 60;
/// Where those fail: the coarse solver on the finest level, each step of which may need a dozen factorisations.
/// (Slender bodies of 40 000 unknowns, of which rounding leaves no solution, took eight minutes for it.)
inline constexpr Index most_unknowns_for_newton = 12'000;
inline constexpr int newton_steps = 40;
/// Of the energy gained in the cycle before: where weights are blocks, bounds come back after a correction without them
/// that gained more.
inline constexpr double slow_gain = 0.5;
/// A cycle that changes no more of the phases is nearly a linear one.
inline constexpr int resting_percent = 1;

/// Corrections without bounds need truncation.
bool may_turn(const SolverOptions& options);

/// Whether the cycles of a problem that could hardly be coarsened begin with sweeps alone on the coarsest level. Its
/// coarse solver is a Newton method on about the finest one; where sweeps do not do, active sets solve the problem with
/// fewer factorisations, and faster ones.
/// @param coarsest vectors on the coarsest level
/// @param vectors, couplings on the finest level
bool begins_with_sweeps(const SolverOptions& options, Index coarsest, Index vectors, Offset couplings);

/// The registered linear solvers for active sets, those to be tried first in front; none: cycles have to do.
/// @param block unknowns per vector
/// @param unknowns, coarsest on the finest level and on the coarsest one: where the matrix could hardly be coarsened
///     there is no multigrid for these systems either
std::vector<std::string> solvers_for_active_sets(int block, Offset unknowns, Offset coarsest);

/// What the rules come down to for a problem with several levels.
/// @param aggregates weights of algebraic levels are blocks: smoothed aggregation
/// @param functional an obstacle adds to the energy: then there are cycles alone
std::string describe(const SolverOptions& options, bool aggregates, int block, Offset unknowns, bool functional);

}  // namespace automatic

}  // namespace signorini
