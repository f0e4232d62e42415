#pragma once
#include "core/fem/recovery/pressed_faces.hpp"

namespace signorini {

/// Tangential tractions of friction from nodal forces, which stay as they are: sets ContactNode::traction of an
/// obstacle's nodes in contact that have friction, from the recovered pressures.
///
/// Where a node slips friction bears all it can, by the recovered pressure. Towards the edge of what sticks the
/// traction comes up to that like a square root. So within three rings of a node that slips the squares of what is left
/// up to there are fitted, by linear polynomials over nodes all of whose neighbours stick. Farther inside the
/// components are fitted, as recover_pressure() does it. What is fitted stays between the means around a node, but for
/// a quarter of them; where samples are few it is the mean. Nowhere it is more than friction bears.
template <int D, int B>
void recover_traction(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, const PressedFaces<D, B>& faces);

}  // namespace signorini
