#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// Replaces tetrahedra without volume: those that a Delaunay mesh has where more than four vertices lie on one sphere
/// and four of them in one plane, as in symmetric solids. Exudation does not move vertices at corners and edges, so
/// that they stay. Around an edge inside the mesh the tetrahedra are exchanged for others with the same boundary and
/// without that edge, where the worst of these is better. Renews nothing but the elements.
/// @return whether there were any to replace
bool replace_flat_elements(Mesh<3>& mesh);

}  // namespace signorini::geometry
