#pragma once
#include "core/component/registry.hpp"
#include "core/fem/model.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// The scene's boundary value problem at the step parameter t. The obstacle types it names must be registered.
template <int B>
Model<B> build_model(const Scene& scene, int dimension, const Registry& registry, double t);

}  // namespace signorini
