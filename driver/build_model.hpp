#pragma once
#include "core/component/registry.hpp"
#include "core/fem/model.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// The boundary value problem of one body at the step parameter t: its fixes, loads and obstacles in the scene's order.
/// The obstacle types it names must be registered.
template <int B>
Model<B> build_model(const Scene& scene, int dimension, const Registry& registry, double t, std::size_t body = 0);

/// Says where the model's obstacles were at the step parameter t of the last step: friction counts from there.
template <int B>
void place_before(const Scene& scene, int dimension, double t, std::size_t body, Model<B>& model);

}  // namespace signorini
