#pragma once
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// A row of faces around an axis, which with two vertices across lie on a cylinder or cone.
struct Row {
  Curve<3> shape;
  std::vector<Index> faces;
};

/// Where rows beside each other meet at an edge of the body: where the profile that they turn about their axis has
/// a corner, see find_edges(). A cone and a cylinder of long facets are told from a barrel like that, however many
/// facets there are around.
/// @param across per face and tip the face and tip beyond, three times its number and the tip; -1 at edges and borders
/// @param digits length by which vertices are off
/// @return faces' joints, three times the face's number and the tip, of either side
std::vector<Index> find_profile_edges(std::span<const Point<3>> points, const std::vector<std::array<Index, 3>>& faces,
                                      const std::vector<Index>& across, const std::vector<Row>& rows, double crease,
                                      double digits);

}  // namespace signorini::geometry
