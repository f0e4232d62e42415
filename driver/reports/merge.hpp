#pragma once
#include <vector>

#include "core/io/report.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// The reports of all bodies of a scene for one step as one, in the order of the scene's tables. Bodies that are not
/// coupled are solved one after the other: iterations, stages, history, unknowns and energies add up, the largest
/// residual and error count, and what one of them did not reach all did not.
StepReport merged(const Scene& scene, std::vector<StepReport> bodies);

}  // namespace signorini
