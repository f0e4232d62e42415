#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini {

/// Red refinement: every triangle becomes 4, every tetrahedron 8. Elements are in the order of their lowest layers,
/// then in that of their fathers; vertices are numbered in the order in which the elements first meet them. Child k of
/// boundary face f is face k + 2^(D-1) f; parts and curves are inherited, and midpoints of edges of curved faces are
/// moved onto the curve.
///
/// An octahedron inside a tetrahedron is cut along its shortest diagonal; among equal ones along that between the
/// midpoints of edges 02 and 13 of the element, as in Bey, Computing 55 (1995), so that Kuhn meshes stay Kuhn meshes.
///
/// Error(Exit::input) if the fine mesh has more elements or vertices than Index can count.
template <int D>
Refinement refine_uniformly(const Mesh<D>& coarse, Mesh<D>& fine);

/// `coarsest` and `uniform` refinements of it, of which the fathers of elements are not kept.
template <int D>
MeshHierarchy<D> hierarchy(Mesh<D> coarsest, int uniform);

/// What hierarchy(coarsest, uniform) would hold, found without building it: exact numbers on the finest level, and the
/// memory of the meshes and refinements of all levels.
struct HierarchySize {
  double vertices, elements, bytes;
};
template <int D>
HierarchySize hierarchy_size(const Mesh<D>& coarsest, int uniform);

}  // namespace signorini
