#pragma once
#include <array>
#include <memory>
#include <optional>
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

/// A node of a slave side that is tied to the master: its jump is prescribed to be zero where no fix holds it.
struct TiedNode {
  Index node;
  Index obstacle;  ///< number in Model::obstacles
  double bears =
      1;  ///< part of the node's area that the master is in front of, and what it takes over of nodes beside it
};

/// The nodes of a rigid part, see core/fem/pairs/rigid_parts.hpp.
template <int B>
struct RigidNodes {
  std::vector<Index> nodes;                      ///< ascending
  std::array<Index, 3> carriers = {-1, -1, -1};  ///< of displacement and rotation, and one that is left over in 3D
  std::array<double, B> point{};                 ///< that is displaced
  double length = 1;                             ///< the second carrier has the rotation times that
};

/// A tie that a bolt's pretension closes, see core/fem/pairs/pretension.hpp.
template <int B>
struct PretensionedTie {
  Index obstacle;                ///< number in Model::obstacles
  Index carrier;                 ///< the node that has the unknown
  std::array<double, B> normal;  ///< out of the slave
  int copies = 1;                ///< of this part, with its images beyond planes of symmetry: they share the force
};

/// A node of a slave at which a condition of contact is left away, for other ones hold at all nodes of a face there.
struct LostNode {
  Index node;
  Index obstacle;  ///< whose condition that is
  Index by = -1;   ///< another obstacle; -1: a circle of masters that are slaves
};

/// What nodes of slave sides see of the masters in the mean: the sum of w_q u_q in all directions, also those that are
/// no part of their jumps.
struct MasterMeans {
  std::vector<Index> node;     ///< ascending
  std::vector<Offset> row{0};  ///< node.size() + 1
  std::vector<Index> column;
  std::vector<double> weight;
};

/// The sides of a model's bodies that may touch each other, coupled by mortar on one mesh.
template <int B>
struct PairedBodies {
  std::vector<PairedNode<B>> nodes;  ///< of one obstacle after the other, each by ascending node
  std::vector<TiedNode> ties;        ///< by ascending node
  std::vector<RigidNodes<B>> rigid;  ///< as Model::rigid
  std::vector<PretensionedTie<B>> pretensioned;
  std::optional<LostNode> lost;  ///< the first one of those; not admitted on the finest mesh
  std::shared_ptr<const Jumps<B>> jumps;
  std::shared_ptr<const MasterMeans> means;  ///< of all nodes that there are; null: not known
};

}  // namespace signorini
