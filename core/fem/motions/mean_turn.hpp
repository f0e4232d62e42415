#pragma once
#include <vector>

#include "core/fem/elements/nodes.hpp"

namespace signorini {

/// The angles, in radians, by which displacements turn bodies: those of the linear displacements next to them, by least
/// squares over the vertices, as far as these are rotations.
/// @param of_node per node the number of its body; empty: there is one
/// @param u displacements, D per node
template <int D>
std::vector<double> mean_turns(const Nodes<D>& nodes, const std::vector<Index>& of_node, const std::vector<double>& u);

}  // namespace signorini
