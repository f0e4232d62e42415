#include <algorithm>

#include "core/scene/read_tables.hpp"

namespace signorini {
namespace {

/// Poisson's ratio above which linear elements lock, see nearly_incompressible.
constexpr double locking = 0.45;

bool locks(const std::optional<Field>& poisson) { return poisson && poisson->constant().value_or(0) > locking; }

/// Elasticity in which a pressure may have unknowns.
bool has_pressure(const Scene::Body& body) {
  return body.equation == Scene::Equation::elasticity && body.plane != Plane::stress;
}

bool locks(const Scene& scene, const Scene::Body& body) {
  return has_pressure(body) &&
         (locks(body.poisson) || std::ranges::any_of(scene.materials, [&](const Scene::Material& material) {
            return material.body == body.name && locks(material.poisson);
          }));
}

/// A body that touches one with quadratic elements has them, too, and the same kind of pressure, unless the scene says
/// otherwise.
bool take_over(Scene::Body& body, const Scene::Body& other) {
  const bool order = body.order < other.order && !body.source.given("order");
  const bool pressure = !body.pressure && other.pressure.value_or(Pressure::none) != Pressure::none;
  if (order) body.order = other.order;
  if (pressure) body.pressure = other.pressure;
  return order || pressure;
}

void take_over_from_touching(Scene& scene) {
  const auto named = [&](const std::string& name) { return std::ranges::find(scene.bodies, name, &Scene::Body::name); };
  for (bool more = true; more;) {
    more = false;
    for (const Scene::Obstacle& obstacle : scene.obstacles) {
      const auto body = named(obstacle.body), other = named(obstacle.other);
      if (body == scene.bodies.end() || other == scene.bodies.end()) continue;
      more = take_over(*body, *other) || take_over(*other, *body) || more;
    }
  }
}

}  // namespace

void choose_elements(Scene& scene) {
  for (Scene::Body& body : scene.bodies)
    if (!body.pressure && !body.source.given("order") && locks(scene, body)) body.order = 2;
  take_over_from_touching(scene);
  for (Scene::Body& body : scene.bodies)
    if (!body.pressure) body.pressure = body.order == 2 && has_pressure(body) ? Pressure::linear : Pressure::none;
}

}  // namespace signorini
