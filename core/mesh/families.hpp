#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini {

/// Puts midpoints of edges into the middle between their ends again where a family, as a quadratic element, would be
/// turned inside out or nearly so: where its map's determinant at a node is less than a twentieth of the flat
/// element's.
/// @return how many
template <int D>
Index straighten_families(Mesh<D>& mesh);

}  // namespace signorini
