#pragma once
#include <string>
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/io/report.hpp"
#include "core/io/warning.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// Bodies whose loads are lost in the tolerance or in rounding: what acts on them does not balance beside their loads.
/// @param load Discretization::load
/// @param report of this body alone, with its parts
/// @param rounding forces that are no larger are none
template <int D, int B>
Warnings balance_warnings(const Scene& scene, const Scene::Body& body, const Nodes<D>& nodes,
                          const std::vector<double>& load, const StepReport& report, double rounding);

/// What is left of the forces on a body over the largest that acts on it, its applied loads, reactions or an obstacle:
/// the largest of its parts. Forces that cancel within one of these are known by their work alone.
/// @param report of this body alone, with its parts
/// @param u its displacements
double imbalance(const StepReport& report, const std::vector<double>& u);

}  // namespace signorini
