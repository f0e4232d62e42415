#pragma once
#include <memory>
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/recovery/stress.hpp"
#include "core/sdk/error_estimator.hpp"

namespace signorini {

/// The stress of a solution u as estimators of plugins see it; keeps references to all.
/// @tparam B 1: its flux
template <int D, int B>
std::unique_ptr<SampledStress> stress_at_points(const Nodes<D>& nodes, const Model<B>& model,
                                                const std::vector<double>& u, const OwnPressure<B>& pressure);

}  // namespace signorini
