#include "core/scene/rigid_shape.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/geometry/shapes.hpp"

namespace signorini {
namespace {

struct Converter {
  int dimension;
  double t;
  const std::string& origin;

  using Result = std::unique_ptr<DistanceFunction>;

  Result operator()(const Scene::PlaneShape& s) const { return geometry::plane(s.point, s.normal, t, origin); }
  Result operator()(const Scene::SphereShape& s) const {
    return geometry::sphere(s.center, s.radius, s.inside, t, origin);
  }
  Result operator()(const Scene::CylinderShape& s) const {
    return geometry::cylinder(s.center, s.axis, s.radius, false, t, origin);
  }
  Result operator()(const Scene::SurfaceShape& s) const {
    try {
      return geometry::engine<3>().surface(s.file.string(), s.crease);
    } catch (const Error& error) {
      throw Error(error.status(), fmt::format("{}: {}", origin, error.what()));
    }
  }
  Result operator()(const Scene::ExpressionShape& s) const {
    return geometry::expression(s.distance, s.normal, dimension, t, origin);
  }
};

}  // namespace

std::shared_ptr<const DistanceFunction> rigid_shape(const Scene::ObstacleShape& shape, int dimension, double t,
                                                    const std::string& origin) {
  return std::visit(Converter{dimension, t, origin}, shape);
}

}  // namespace signorini
