#include "core/scene/reference_point.hpp"

#include "core/base/error.hpp"

namespace signorini {
namespace {

/// Of a shape; null where it has none.
struct PointOf {
  using Fields = const std::vector<Field>*;

  Fields operator()(const Scene::PlaneShape& shape) const { return &shape.point; }
  Fields operator()(const Scene::SphereShape& shape) const { return &shape.center; }
  Fields operator()(const Scene::CylinderShape& shape) const { return &shape.center; }
  Fields operator()(const Scene::SurfaceShape&) const { return nullptr; }
  Fields operator()(const Scene::ExpressionShape&) const { return nullptr; }
};

}  // namespace

std::array<double, 3> reference_point(const Scene::Obstacle& obstacle, double t) {
  const std::vector<Field>* fields = obstacle.shape ? std::visit(PointOf(), *obstacle.shape) : nullptr;
  std::array<double, 3> point{};
  if (!fields) return point;
  Site origin;
  origin.t = t;
  try {
    for (std::size_t k = 0; k < fields->size(); ++k) point[k] = (*fields)[k](origin);
  } catch (const Error&) {
    return {};
  }
  return point;
}

}  // namespace signorini
