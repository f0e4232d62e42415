#include <algorithm>

#include "core/scene/read_tables.hpp"

namespace signorini {
namespace {

/// Poisson's ratio above which linear elements lock, see nearly_incompressible.
constexpr double locking = 0.45;

bool locks(const std::optional<Field>& poisson) { return poisson && poisson->constant().value_or(0) > locking; }

}  // namespace

void choose_elements(Scene& scene) {
  for (Scene::Body& body : scene.bodies) {
    if (body.pressure) continue;
    body.pressure = Pressure::none;
    if (body.equation != Scene::Equation::elasticity || body.plane == Plane::stress) continue;
    const bool any = locks(body.poisson) || std::ranges::any_of(scene.materials, [&](const Scene::Material& material) {
                       return material.body == body.name && locks(material.poisson);
                     });
    if (any && !body.source.given("order")) body.order = 2;
    if (body.order == 2) body.pressure = Pressure::linear;
  }
}

}  // namespace signorini
