#pragma once
#include <span>
#include <vector>

#include "core/geometry/flat_parts.hpp"
#include "core/geometry/known.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// Parts of a surface of flat faces (D = 2: of a curve of edges) whose vertices are on a cylinder, cone, sphere or
/// torus (a circle), as far as digits that a file has rounded away let it be known.
template <int D>
struct ShapeParts {
  std::vector<Index> part;  ///< per face the number of its shape, or -1
  std::vector<Curve<D>> shapes;
  std::vector<Index> edges;  ///< D times a face's number and the tip: where rows around an axis have been parted
};

/// Faces that belong together, by `across`, are looked at as a whole, then without flat parts, then by what some of
/// them are on: a few beside each other, or three plates whose lines have three vertices or more. Rows of plates with
/// two vertices across tell nothing by themselves, for every surface of revolution has cones in it: their profile does,
/// see find_profile_edges(). What others leave over is looked at again, and may be flat as well; so are faces of the
/// same names. Of curved faces, nodes in the middle of edges have to be on the shape, too. In the end, faces
/// beside a shape that are exactly on it, and turn no farther than its own, or have the tip of a cone, belong to it,
/// whatever edges say.
/// @param across per face and tip the face and tip beyond, D times its number and the tip; -1 at edges and borders
/// @param beyond the same for all joints; -1 at borders
/// @param flats gets what is left over between others and flat, and loses what belongs to shapes
/// @param crease angle in radians: faces at as much to a shape do not stand for it
template <int D>
ShapeParts<D> find_shape_parts(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces,
                               const std::vector<Index>& across, const std::vector<Index>& beyond, FlatParts<D>& flats,
                               double crease, const Known<D>& known = {});

}  // namespace signorini::geometry
