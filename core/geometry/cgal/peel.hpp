#pragma once
#include "core/geometry/cgal/filled.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// Takes off tetrahedra that lie flat on the surface: two faces on the boundary, at more than 175 degrees to each
/// other. The two other faces take their place, so that the boundary only swaps an edge. Exudation cannot reach these
/// slivers. Faces that meet at a crease stay. Needs and renews Mesh::boundary, and comes before any part or curve is
/// assigned.
void peel_slivers(Mesh<3>& mesh, const std::vector<CreaseEdge>& creases);

}  // namespace signorini::geometry
