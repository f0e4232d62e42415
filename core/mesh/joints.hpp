#pragma once
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// Where elements of a valid mesh hang together by less than a face.
struct Hinges {
  std::vector<Index> vertices;              ///< around which the elements are not all joined by faces that hold them
  std::vector<std::array<Index, 2>> edges;  ///< the same; 3D only. Their ends are not among `vertices`.
};

/// O(n log n) in the number of boundary faces; linear in that of elements where there are hinges at vertices.
Hinges find_hinges(const Mesh<2>& mesh);
Hinges find_hinges(const Mesh<3>& mesh);

/// A boundary vertex inside a boundary face (or, in 3D, an edge of one) that it is no vertex of: there the elements do
/// not meet face to face, or the body touches itself.
struct HangingVertex {
  Index vertex;
  Index face;  ///< one of these faces, number in Mesh::boundary
};

/// By ascending vertex, each once. A vertex lies inside a face when it is no farther from it than 1e-9 of its longest
/// edge, and farther from its corners. O(n log n) in the number of boundary faces of not too uneven shape.
template <int D>
std::vector<HangingVertex> find_hanging_vertices(const Mesh<D>& mesh);

}  // namespace signorini
