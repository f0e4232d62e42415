#pragma once
#include "core/fem/recovery/counterforces.hpp"

namespace signorini {

/// What contact between bodies does at the nodes of the masters that a slave is in front of, as ContactNode has it for
/// the slave's: forces and pressures are those of the counterforces, gaps the distances that displacements leave. Per
/// obstacle by ascending node.
/// @param u global coordinates, B per node
template <int D, int B>
std::vector<ContactNode<B>> master_side(const Nodes<D>& nodes, const Model<B>& model,
                                        const std::vector<NodalForce<B>>& counterforces, const std::vector<double>& u);

}  // namespace signorini
