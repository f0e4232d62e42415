#pragma once
#include <array>
#include <memory>
#include <vector>

#include "core/base/types.hpp"
#include "core/solver/jumps.hpp"

namespace signorini {

/// A node of a slave side with a part of the master's side in front of it.
template <int B>
struct PairedNode {
  Index node;
  Index obstacle;              ///< number in Model::obstacles
  std::array<double, B> away;  ///< unit normal from the master to the slave; with friction see free_normal()
  double gap;                  ///< mean distance along it, see MortarCoupling::distance(): a coefficient
  double part = 1;             ///< of the distance in the node's bound, see MortarCoupling::part()
  double covered = 1;          ///< part of the node's area that the master is in front of
  double taken = 0;            ///< what it takes over of nodes that are left out, over its area
};

/// The sides of a model's bodies that may touch each other, coupled by mortar on one mesh.
template <int B>
struct PairedBodies {
  std::vector<PairedNode<B>> nodes;  ///< of one obstacle after the other, each by ascending node
  std::shared_ptr<const Jumps<B>> jumps;
};

}  // namespace signorini
