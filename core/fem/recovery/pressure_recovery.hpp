#pragma once
#include "core/fem/recovery/contact_surface.hpp"

namespace signorini {

/// Contact pressure of second order from nodal forces, which stay as they are.
///
/// The force at a node over the area of its hat function is the mean of the pressure there, which is its value at the
/// centroid of that function, not at the node, but for what the pressure's curvature adds: with quadratic elements,
/// where it bulges, that is found by a first fit, and taken off. Squares of these values are fitted by quadratic
/// polynomials over three rings of neighbours (at the edge five), by least squares. Why squares? At the edge of smooth
/// contact the pressure ends like a square root; its square goes through zero there like a straight line. Only nodes
/// count whose neighbours are all in contact: the others feel the edge, and what is fitted goes on to them and to the
/// edge. Where no node is at an edge, the values themselves are fitted. Where they scatter about the fit, so that what
/// it finds may be off by more than 1 %, up to six rings are looked at, as long as these meet no edge.
///
/// Sets ContactNode::recovered of an obstacle's nodes, and ContactNode::traction from it
/// (core/fem/recovery/traction_recovery.hpp). The pressure lies between the least and 1.25 times the largest of the
/// means at the node and its neighbours, so that neither singular pressures nor contacts of a few nodes spoil it; and
/// at the edge of coarse contacts not below what of a node's mean the pressure farther inside does not explain. Where
/// too few nodes are around, or it rises towards the edge as under a punch, it is the mean.
/// @param least_force forces up to this one are none
/// @return `area`, the measure of the contact: of the faces, or parts of faces, where what is fitted is positive. Where
/// it does not fall towards the edge, as under a punch, contact goes on as far as PressedFaces::reach(). `resolved`:
/// where the largest pressure is there are nodes enough inside the contact for a fit, in 3D in two rows or more; or no
/// node is at its edge. Where an edge or a tip lies there, nodes enough on either side. `peaks_at_edge`: the largest
/// pressure is at its edge, or at an edge or a tip within, as where an edge or a corner of a body touches: smaller
/// elements find larger ones. `error`: what errors of the forces, independent of each other and as large as these
/// scatter about the fits, do to pressures, in the mean over nodes inside the contact; over the largest pressure.
/// Infinite where nothing tells.
struct RecoveredPressure {
  double area = 0;
  bool resolved = true, peaks_at_edge = false;
  double error = infinity;
};
template <int D, int B>
RecoveredPressure recover_pressure(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, Index obstacle,
                                   double least_force, std::vector<ContactNode<B>>& contact);

}  // namespace signorini
