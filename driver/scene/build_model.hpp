#pragma once
#include "core/component/registry.hpp"
#include "core/fem/model/model.hpp"
#include "core/scene/scene.hpp"
#include "core/sdk/stepping.hpp"

namespace signorini {

/// The boundary value problem of one body at the end of a load step: its fixes, loads and obstacles in the scene's
/// order. The obstacle types it names must be registered.
template <int B>
Model<B> build_model(const Scene& scene, int dimension, const Registry& registry, const LoadStep& step,
                     std::size_t body = 0);

/// The same at the step parameter t, of what is looked at alone: a single step from 0 to there.
template <int B>
Model<B> build_model(const Scene& scene, int dimension, const Registry& registry, double t, std::size_t body = 0) {
  return build_model<B>(scene, dimension, registry, LoadStep{1, 0, t}, body);
}

/// The extension of an obstacle that depends on its step; null: it has none.
template <int B>
const Stepping* stepping(const ObstacleTerm<B>& term) {
  return dynamic_cast<const Stepping*>(term.obstacle.get());
}

/// Says where the model's obstacles were at the step parameter t of the last step: friction counts from there.
template <int B>
void place_before(const Scene& scene, int dimension, double t, std::size_t body, Model<B>& model);

}  // namespace signorini
