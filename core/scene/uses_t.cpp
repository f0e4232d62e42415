#include "core/scene/uses_t.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/input/expression.hpp"

namespace signorini {
namespace {

bool any(const Field& field) { return field.uses_t(); }
bool any(const std::optional<Field>& field) { return field && field->uses_t(); }
bool any(const std::optional<Selection>& selection) { return selection && any(selection->where); }

template <class T>
bool any(const std::vector<T>& fields) {
  return std::ranges::any_of(fields, [](const T& field) { return any(field); });
}

struct ShapeUses {
  bool operator()(const Scene::PlaneShape& s) const { return any(s.point) || any(s.normal); }
  bool operator()(const Scene::SphereShape& s) const { return any(s.center) || any(s.radius); }
  bool operator()(const Scene::CylinderShape& s) const { return any(s.center) || any(s.axis) || any(s.radius); }
  bool operator()(const Scene::SurfaceShape&) const { return false; }
  bool operator()(const Scene::ExpressionShape& s) const { return any(s.distance) || any(s.normal); }
};

/// Of a plugin's option, whose type is not known here: a text that is no expression depends on nothing.
bool any(const RawValue& raw) {
  if (const auto* list = std::get_if<RawValue::List>(&raw.value))
    return std::ranges::any_of(*list, [](const RawValue& entry) { return any(entry); });
  const auto* text = std::get_if<std::string>(&raw.value);
  if (!text) return false;
  try {
    return compile_expression(*text, raw.origin).uses_t();
  } catch (const Error&) {
    return false;
  }
}

bool any(const Scene::Body& body) {
  return any(body.young) || any(body.poisson) || any(body.diffusion) || any(body.expansion) || any(body.temperature);
}
bool any(const Scene::Material& material) {
  return any(material.young) || any(material.poisson) || any(material.diffusion) || any(material.expansion);
}
bool any(const Scene::Fix& fix) { return any(fix.on.where) || any(fix.value); }
bool any(const Scene::Load& load) {
  return any(load.on) || any(load.value) || any(load.pressure) || any(load.force) || any(load.torque);
}
bool any(const Scene::Spring& spring) { return any(spring.on.where) || any(spring.stiffness); }
bool any(const Scene::Rigid& rigid) {
  return any(rigid.on.where) || any(rigid.displacement) || any(rigid.rotation) || any(rigid.force) || any(rigid.torque);
}
bool any(const Scene::Obstacle& obstacle) {
  return any(obstacle.on) || any(obstacle.pretension) || (obstacle.shape && std::visit(ShapeUses(), *obstacle.shape)) ||
         std::ranges::any_of(obstacle.options.entries, [](const auto& entry) { return any(entry.second); });
}

}  // namespace

bool uses_t(const Scene& scene, const Scene::Body& body) {
  const auto in = [&](const auto& tables) {
    return std::ranges::any_of(tables, [&](const auto& table) { return body.answers_to(table.body) && any(table); });
  };
  const bool parts = std::ranges::any_of(body.parts, [](const Scene::Body& part) { return any(part); });
  return any(body) || parts || in(scene.materials) || in(scene.fixes) || in(scene.loads) || in(scene.springs) ||
         in(scene.rigids) || in(scene.obstacles);
}

}  // namespace signorini
