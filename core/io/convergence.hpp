#pragma once
#include <string>
#include <vector>

#include "core/solver/summary.hpp"

namespace signorini {

/// The history of a solve as aligned columns for people, with a heading.
std::string convergence_table(const std::vector<IterationRecord>& history);

/// Its heading and a row of it, without a line break.
std::string convergence_heading();
std::string convergence_row(const IterationRecord& record);

/// The histories of all steps as comma-separated values in full precision, with a heading.
std::string convergence_csv(const std::vector<const Summary*>& steps);
/// The same per level (coarsest first; algebraic ones have negative numbers): phases and rows recomputed, contact by
/// direction in local coordinates.
std::string phases_csv(const std::vector<const Summary*>& steps);

}  // namespace signorini
