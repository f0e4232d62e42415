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
  /// Per element the points that its edges go through between their ends, in the order of simplex_edges; -1 where an
  /// edge is straight. Empty: all are.
  std::vector<std::array<Index, D*(D + 1) / 2>> middle;
  std::vector<Offset> label;  ///< per element, its number in the file; empty: its position
  std::vector<FaceGroup<D>> groups;
};

/// Drops vertices that no element uses, turns elements that are numbered negatively (those of surfaces with their
/// normal to -z are), finds the boundary and its parts, and validates. An element that a vertex has turned inside out
/// overlaps others, whatever its orientation. Points in the middle of edges make the mesh's elements curved
/// (Mesh::bends) and its curved faces those of one curve of the kind `elements`; where they are in the middle up to
/// rounding bends are zero.
template <int D>
Mesh<D> build_mesh(RawMesh<D> raw, std::string_view place);

}  // namespace signorini
