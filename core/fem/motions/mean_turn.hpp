#pragma once
#include <vector>

#include "core/fem/elements/nodes.hpp"

namespace signorini {

struct MeanTurn {
  double angle = 0;   ///< radians
  double radius = 0;  ///< of gyration of the vertices about their mean

  /// By which linear kinematics, which lead points along tangents, move them off the circles that they ought to stay
  /// on.
  double off_circle() const { return 0.5 * angle * angle * radius; }
};

/// How displacements turn bodies: the angles of the linear displacements next to them, by least squares over the
/// vertices, as far as these are rotations.
/// @param of_node per node the number of its body; empty: there is one
/// @param u displacements, D per node
template <int D>
std::vector<MeanTurn> mean_turns(const Nodes<D>& nodes, const std::vector<Index>& of_node,
                                 const std::vector<double>& u);

}  // namespace signorini
