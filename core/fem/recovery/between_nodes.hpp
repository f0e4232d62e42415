#pragma once
#include "core/fem/recovery/contact.hpp"

namespace signorini {

/// Conditions hold at nodes; how far are they violated between them? The largest violation at points of the faces with
/// a node that is nearer to the obstacle than the face is long, of scalar bodies of those and of elements with a node
/// in contact: at the middles of the edges of linear ones, at the multiples of 1/4 of quadratic ones. Rigid shapes are
/// compared with the deformed boundary. Zero where nothing is violated; NaN where it is not measured: where the
/// obstacle fails there, has no shape in elasticity, or acts on all of a body of linear elements.
/// @param u global coordinates, B per node
template <int D, int B>
double violation_between_nodes(const Nodes<D>& nodes, const Model<B>& model, Index obstacle,
                               const ContactState<B>& state, const std::vector<double>& u);

}  // namespace signorini
