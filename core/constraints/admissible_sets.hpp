#pragma once
#include "core/constraints/bound.hpp"
#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Whether what obstacles admit at their nodes is the box that their directions and bounds describe: line searches and
/// coarse corrections know no more than that. Obstacles with sweeps of their own are asked for the admissible points
/// next to far away ones on all sides of the box. Those of BoxObstacle with its own minimiser are boxes; what a
/// functional adds to the energy would hide the set.
/// @param problem its constraints and segments
/// @param size of what is asked for: points are far beyond it
/// @param all asks boxes with minimisers of their own as well, such as one whose sweep has led to no number
/// @throws Error(Exit::plugin) that names the obstacle and the place where it is none
template <int B>
void check_admissible_sets(const ObstaclePlaces<B>& places, const DiscreteProblem<B>& problem, double size,
                           bool all = false);

}  // namespace signorini
