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

}  // namespace signorini
