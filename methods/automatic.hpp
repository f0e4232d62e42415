#pragma once
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/solver/options.hpp"

namespace signorini {

/// The rules of method "auto" within its stages (stages.hpp): when cycles go without bounds, and what `check` says.
/// On which problems each constant was chosen: docs/measured/variants.md, "Constants".
namespace automatic {

/// Cycles after which corrections without bounds take turns while phases change: more than it needs where multigrid
/// does its work.
inline constexpr int patience_with_bounds = 10;
/// Of the diagonal, where active sets meet a matrix that is singular on the free components.
inline constexpr double shift_if_singular = 1e-10;
/// Of the energy gained in the cycle before: where weights are blocks, bounds come back after a correction without them
/// that gained more.
inline constexpr double slow_gain = 0.5;
/// A cycle that changes no more of the phases is nearly a linear one.
inline constexpr int resting_percent = 1;

/// Corrections without bounds need truncation.
bool may_turn(const SolverOptions& options);

/// What the rules come down to for a problem with several levels.
/// @param aggregates weights of algebraic levels are blocks: smoothed aggregation
/// @param functional an obstacle adds to the energy: then there are no active sets
std::string describe(const SolverOptions& options, bool aggregates, int block, Offset unknowns, bool functional);

}  // namespace automatic

}  // namespace signorini
