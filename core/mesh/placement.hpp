#pragma once
#include <vector>

#include "core/mesh/curve.hpp"

namespace signorini {

/// Where the middle of an edge belongs that lies on one or two boundary faces, and on planes of symmetry.
///
///     Placement<3> placement(mesh);
///     for (const Index f : faces) placement.add(f);
///     const Point<3> x = placement.on_shapes(middle, length);  // where there are shapes()
template <int D>
class Placement {
 public:
  /// @param mesh whose curves and planes of symmetry these are
  explicit Placement(const Mesh<D>& mesh) : mesh_(mesh) {}

  void add(Index face);
  /// Whether a face lies on a curve with a closed form.
  bool shapes() const { return !shapes_.empty(); }
  /// The last of the faces that lies on a curve of the kind `patches`; -1: none.
  Index patch() const { return patch_; }
  /// The point on all of the shapes, and on the planes of flat faces and of symmetry.
  /// @param reach how far from the middle it may be, about the length of the edge
  Point<D> on_shapes(const Point<D>& middle, double reach) const;

 private:
  Flat<D> plane_of(const Face<D>& face) const;

  const Mesh<D>& mesh_;
  std::vector<const Curve<D>*> shapes_;
  std::vector<Flat<D>> planes_;
  Index patch_ = -1;
};

}  // namespace signorini
