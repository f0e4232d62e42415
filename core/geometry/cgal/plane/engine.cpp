#include "core/geometry/cgal/guarded.hpp"
#include "core/geometry/cgal/plane/planar.hpp"
#include "core/geometry/geometry.hpp"

namespace signorini::geometry {
namespace {

class CgalEngine : public Engine<2> {
 public:
  Mesh<2> mesh(const Shape2& shape, const Size<2>& size) const override {
    return guarded("meshing", [&] { return triangulate(shape, size); });
  }
};

}  // namespace
}  // namespace signorini::geometry

extern "C" __attribute__((visibility("default"))) const signorini::geometry::Engine<2>* signorini_plane_engine() {
  static const signorini::geometry::CgalEngine engine;
  return &engine;
}
