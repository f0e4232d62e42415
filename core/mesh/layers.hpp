#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini {

/// Per vertex the number of its layer: the vertices of an element lie in one layer or in two that follow each other.
/// Elements in the order of their lowest layers and vertices in that of the elements then have matrices of small
/// bandwidth. Red refinement doubles the layers: the midpoint of an edge gets the sum of its ends' numbers. Parts of a
/// mesh that do not touch may get layers of their own.
template <int D>
std::vector<Index> layers(const Mesh<D>& mesh);

}  // namespace signorini
