#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// Takes off tetrahedra that lie flat on the surface: two faces on the boundary, at more than 175 degrees to each
/// other. The two other faces take their place, so that the boundary only swaps an edge. Exudation cannot reach these
/// slivers. Needs and renews Mesh::boundary, and comes before any part or curve is assigned.
void peel_slivers(Mesh<3>& mesh);

}  // namespace signorini::geometry
