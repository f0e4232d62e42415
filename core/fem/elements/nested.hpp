#pragma once
#include "core/fem/elements/nodes.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Interpolation of linear elements from a mesh to its refinement, or to quadratic elements with their nodes there:
/// weight 1 at common vertices, 1/2 at the ends of a divided edge.
template <int D>
Prolongation prolongation(const Refinement& refinement, const Nodes<D>& coarse, const Nodes<D>& fine);
/// Between all levels of a hierarchy, coarsest first.
/// @param nodes of each of its meshes
template <int D>
std::vector<Prolongation> prolongations(const MeshHierarchy<D>& hierarchy, const std::vector<Nodes<D>>& nodes);

}  // namespace signorini
