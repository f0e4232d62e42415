#include <CGAL/exceptions.h>

#include "core/geometry/cgal/checks.hpp"
#include "core/geometry/cgal/planar.hpp"
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

/// The condition that failed, or the first line of what CGAL says instead of one.
std::string reason(const CGAL::Failure_exception& failure) {
  const std::string text = failure.expression().empty() ? failure.message() : failure.expression();
  return text.substr(0, text.find('\n'));
}

/// Calls `work`; what CGAL finds itself unable to do, and what does not fit memory, becomes the user's error.
template <class Work>
auto guarded(const char* what, const Work& work) {
  try {
    return work();
  } catch (const CGAL::Failure_exception& failure) {
    throw ShapeError(what, "",
                     fmt::format("failed for this geometry ({}); expected one without degenerate details, or another "
                                 "size",
                                 reason(failure)));
  } catch (const std::bad_alloc&) {
    throw ShapeError(what, "", "out of memory; expected a larger size");
  }
}

class CgalEngine : public Engine {
 public:
  Mesh<2> mesh(const Shape2& shape, const Size<2>& size) const override {
    return guarded("meshing", [&] { return triangulate(shape, size); });
  }
  Mesh<3> mesh(const Shape3& shape, const Size<3>& size) const override {
    return guarded("meshing", [&] { return std::visit([&](const auto& s) { return mesh_of(s, size); }, shape); });
  }
  std::unique_ptr<DistanceFunction> surface(const std::string& file, std::optional<double> crease) const override {
    return guarded("reading a surface", [&] { return surface_distance(file, crease); });
  }
};

}  // namespace

}  // namespace signorini::geometry

extern "C" __attribute__((visibility("default"))) const signorini::geometry::Engine* signorini_geometry_engine() {
  static const signorini::geometry::CgalEngine engine;
  return &engine;
}
