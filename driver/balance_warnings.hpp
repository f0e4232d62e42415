#pragma once
#include <string>
#include <vector>

#include "core/fem/forces.hpp"
#include "core/fem/nodes.hpp"
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
/// the largest of its parts. Forces that cancel within a fix count.
/// @param report of this body alone, with its parts
template <int D, int B>
double imbalance(const Scene& scene, const Scene::Body& body, const StepReport& report, const Forces<B>& forces);

}  // namespace signorini
