#pragma once
#include <string_view>
#include <vector>

#include "core/mesh/boundary.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// A mesh as files give it. Vertex numbers must be in range; anything else may be wrong.
template <int D>
struct RawMesh {
  std::vector<Point<D>> points;
  std::vector<std::array<Index, D + 1>> elements;
  std::vector<Index> entity;  ///< per element, the geometric entity it meshes; empty: one for all
  std::vector<Offset> label;  ///< per element, its number in the file; empty: its position
  std::vector<FaceGroup<D>> groups;
};

/// Drops vertices that no element uses, turns entities whose elements are numbered negatively (surfaces with their
/// normal to -z are), finds the boundary and its parts, and validates. A single element that is oriented differently
/// from the rest of its entity is not mended: it is an inverted one.
template <int D>
Mesh<D> build_mesh(RawMesh<D> raw, std::string_view place);

}  // namespace signorini
