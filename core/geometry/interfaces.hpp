#pragma once
#include <array>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// Inner faces between elements of two regions as a boundary of their own, with their normals out of the region with
/// the smaller number.
template <int D>
std::vector<Face<D>> faces_between(const Mesh<D>& mesh, Index region, Index other);

/// Pairs of regions, the smaller number first, whose elements share faces.
template <int D>
std::vector<std::array<Index, 2>> neighbouring_regions(const Mesh<D>& mesh);

/// Bends the elements of a straight mesh at inner faces to the curves and patches that these are on (Mesh::bends).
/// @param inner the same points and elements, with inner faces in place of the boundary
template <int D>
void bend_elements(Mesh<D>& mesh, const Mesh<D>& inner);

}  // namespace signorini::geometry
