#pragma once
#include <string>
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/io/report.hpp"
#include "core/io/warning.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// Bodies on which what acts does not balance, beside their loads or, where they have none, beside what acts: loads are
/// lost in the tolerance or in rounding, or a force is missing.
/// @param load Discretization::load
/// @param report of this body alone, with its parts
/// @param u its displacements
/// @param rounding forces that are no larger are none
template <int D, int B>
Warnings balance_warnings(const Scene& scene, const Scene::Body& body, const Nodes<D>& nodes,
                          const std::vector<double>& load, const StepReport& report, const std::vector<double>& u,
                          double rounding);

/// What is left of the forces on a body over the largest that acts on it, its applied loads, reactions or an obstacle:
/// the largest of its parts. Forces that cancel within one of these are known by their work alone.
/// @param report of this body alone, with its parts
/// @param u its displacements
double imbalance(const StepReport& report, const std::vector<double>& u);

}  // namespace signorini
