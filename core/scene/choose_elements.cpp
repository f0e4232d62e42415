#include <algorithm>

#include "core/scene/read_tables.hpp"

namespace signorini {
namespace {

/// Bodies that touch each other have elements of one order, and one kind of pressure: what the scene says of one of
/// them holds for those of which it says nothing.
bool take_over(Scene::Body& body, const Scene::Body& other) {
  const bool order = body.order == 0 && other.order != 0, pressure = !body.pressure && other.pressure;
  if (order) body.order = other.order;
  if (pressure) body.pressure = other.pressure;
  return order || pressure;
}

template <class Visit>
void for_touching(Scene& scene, const Visit& visit) {
  const auto named = [&](const std::string& name) { return std::ranges::find(scene.bodies, name, &Scene::Body::name); };
  for (const Scene::Obstacle& obstacle : scene.obstacles) {
    const auto body = named(obstacle.body), other = named(obstacle.other);
    if (body != scene.bodies.end() && other != scene.bodies.end()) visit(*body, *other);
  }
  Scene::Body* last = nullptr;  // of those that may turn out to touch each other
  for (Scene::Body& body : scene.bodies) {
    if (!scene.looks_for_pairs(body)) continue;
    if (last) visit(*last, body);
    last = &body;
  }
}

void take_over_from_touching(Scene& scene) {
  for (bool more = true; more;) {
    more = false;
    for_touching(scene, [&](Scene::Body& body, Scene::Body& other) {
      more = take_over(body, other) || take_over(other, body) || more;
    });
  }
}

/// Linear elements bend too little. Nothing bends where the unknown is scalar, and there the values of linear ones stay
/// on their side of an obstacle at all nodes (docs/measured/accuracy.md).
int best_order(const Scene::Body& body) { return body.equation == Scene::Equation::elasticity ? 2 : 1; }

}  // namespace

void choose_elements(Scene& scene) {
  for (Scene::Body& body : scene.bodies) body.order_chosen = body.order_chosen || body.order == 0;
  take_over_from_touching(scene);
  if (scene.solver.bodies == "dirichlet-neumann")  // which has linear elements alone
    for_touching(scene, [](Scene::Body& body, Scene::Body& other) {
      for (Scene::Body* touching : {&body, &other})
        if (touching->order == 0) touching->order = 1;
    });
  for (Scene::Body& body : scene.bodies) {
    if (body.order == 0) body.order = best_order(body);
    if (body.order == 1 || body.equation == Scene::Equation::diffusion || body.plane == Plane::stress)
      body.pressure = Pressure::none;
    if (!body.pressure) body.pressure = Pressure::linear;
  }
}

}  // namespace signorini
