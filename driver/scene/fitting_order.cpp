#include "driver/scene/fitting_order.hpp"
#include "core/io/warning_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace signorini {
namespace {

void take(Scene::Body& body, int order, std::optional<Pressure> pressure) {
  body.order = order;
  body.pressure = pressure;
  for (Scene::Body& part : body.parts) take(part, order, pressure);
}

}  // namespace

bool take_linear_elements(Scene& scene, std::size_t number, const TooLarge& why, Warnings& warnings) {
  Scene::Body& body = scene.bodies[number];
  if (body.order == 1 || !body.order_chosen) return false;
  take(body, 1, Pressure::none);
  warnings.push_back(warning<"linear-elements">(body.source.table, why.complaint()));
  return true;
}

void keep_chosen_orders(const Scene& kept, Scene& scene) {
  for (std::size_t k = 0; k < std::min(kept.bodies.size(), scene.bodies.size()); ++k)
    if (scene.bodies[k].order_chosen) take(scene.bodies[k], kept.bodies[k].order, kept.bodies[k].pressure);
}

}  // namespace signorini
