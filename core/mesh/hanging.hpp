#pragma once
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

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
