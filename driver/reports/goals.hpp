#pragma once
#include <string>

#include "core/io/report.hpp"
#include "core/scene/scene.hpp"
#include "driver/reports/results.hpp"
#include "estimators/goal.hpp"

namespace signorini {

/// Error(Exit::input) where the goal of the scene's adaptive run is of no use for this body, with the reason.
/// @param own_pressure whether pressures have unknowns of their own
template <int D, int B>
void check_goal(const Scene& scene, std::size_t body, const Model<B>& model, bool own_pressure);

/// What the scene asks for of a solution: its value is that of the whole body, as the report has it.
/// @param report of the results, with contact and probes
template <int D, int B>
Quantity<B> goal_of(const Scene& scene, const Nodes<D>& nodes, const Probes<D>& probes,
                    const Discretization<B>& discretization, const Results<D, B>& results, const StepReport& report);

/// "force 0.01568, error about 0.02 %"
std::string error_text(const GoalReport& goal);

}  // namespace signorini
