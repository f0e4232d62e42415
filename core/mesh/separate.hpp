#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini {

/// Divides elements with several boundary faces on one curve, so that every element has at most one. Under refinement
/// the faces of such an element approach a common tangent plane, and the element between them degenerates. Boundary
/// faces and parts stay as they are; new vertices are appended, elements are divided around interior edges.
template <int D>
void separate_curved_faces(Mesh<D>& mesh);

}  // namespace signorini
