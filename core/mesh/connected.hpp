#pragma once
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// Per vertex the number of the part of the mesh that it belongs to; parts have no vertex in common and are counted in
/// the order of their first vertices.
template <int D>
std::vector<Index> connected_parts(const Mesh<D>& mesh);

}  // namespace signorini
