#include "core/geometry/cgal/checks.hpp"
#include "core/geometry/cgal/guarded.hpp"
#include "core/geometry/cgal/round.hpp"
#include "core/geometry/cgal/solid.hpp"
#include "core/geometry/cgal/surface_distance.hpp"
#include "core/geometry/cgal/tetrahedra.hpp"
#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

namespace {

void check(const Ball& ball) {
  const char* shape = ball.lower_half ? "half_ball" : "ball";
  require_finite(shape, "center", ball.center);
  require_positive(shape, "radius", ball.radius);
}

void check(const Cylinder& cylinder) {
  require_finite("cylinder", "center", cylinder.center);
  require_positive("cylinder", "radius", cylinder.radius);
  require_positive("cylinder", "height", cylinder.height);
}

template <class Round>
Mesh<3> mesh_of(const Round& round, const Size<3>& size) {
  check(round);
  return tetrahedralize(RoundDomain(round), size);
}

SolidDomain domain_of(const Solid& solid) {
  try {
    return SolidDomain(solid.file);
  } catch (const Error& error) {
    throw ShapeError("solid", "file", error.what());
  }
}

Mesh<3> mesh_of(const Solid& solid, const Size<3>& size) { return tetrahedralize(domain_of(solid), size); }

class CgalEngine : public Engine<3> {
 public:
  Mesh<3> mesh(const Shape3& shape, const Size<3>& size) const override {
    return guarded("meshing", [&] { return std::visit([&](const auto& s) { return mesh_of(s, size); }, shape); });
  }
  std::unique_ptr<DistanceFunction> surface(const std::string& file, std::optional<double> crease) const override {
    return guarded("reading a surface", [&] { return surface_distance(file, crease); });
  }
};

}  // namespace

}  // namespace signorini::geometry

extern "C" __attribute__((visibility("default"))) const signorini::geometry::Engine<3>* signorini_geometry_engine() {
  static const signorini::geometry::CgalEngine engine;
  return &engine;
}
