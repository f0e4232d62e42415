#pragma once
#include <array>
#include <memory>
#include <vector>

#include "core/fem/fixes.hpp"
#include "core/solver/jumps.hpp"

namespace signorini {

/// A node of a slave side with a part of the master's side in front of it.
template <int B>
struct PairedNode {
  Index node;
  Index obstacle;              ///< number in Model::obstacles
  std::array<double, B> away;  ///< unit normal from the master to the slave, see free_normal()
  double gap;                  ///< mean distance along it, weighted by the node's dual basis function: a coefficient
  double part = 1;             ///< of the distance in the node's bound, see MortarCoupling::part()
};

/// The sides of a model's bodies that may touch each other, coupled by mortar on one mesh.
template <int B>
struct PairedBodies {
  std::vector<PairedNode<B>> nodes;  ///< of one obstacle after the other, each by ascending node
  std::shared_ptr<const Jumps<B>> jumps;
};

/// Nodes whose displacement is prescribed completely, or along the normal, are left out. Null where the model has no
/// obstacle between bodies.
/// Error(Exit::input) that names the obstacle: a node on several sides, or sides that have faces in common; a slave all
/// of whose nodes are prescribed; bodies that overlap at the start by more than an element of the coarsest mesh.
/// @param fixes collect_fixes() of both
template <int D>
std::shared_ptr<const PairedBodies<D>> pair_bodies(const Nodes<D>& nodes, const Model<D>& model,
                                                   const std::vector<FixedDirections<D>>& fixes);

/// Of all pairs those that nearly touch when the bodies are displaced by u (B per node, global coordinates), and those
/// that `also` has. Far from contact jumps are of no use: there each body is smoothed better by itself.
template <int D>
std::shared_ptr<const PairedBodies<D>> near_contact(const Nodes<D>& nodes, const Model<D>& model,
                                                    const PairedBodies<D>& all, const std::vector<double>& u,
                                                    const PairedBodies<D>* also = nullptr);

/// Whether unknowns are jumps at the same nodes, by the same weights and along the same directions: matrices stay the
/// same. Gaps may differ.
template <int D>
bool same_jumps(const PairedBodies<D>& a, const PairedBodies<D>& b);

/// Of all pairs those that `chosen` has, jumps taken from there: for pairs whose gaps alone are others by now.
template <int D>
std::shared_ptr<const PairedBodies<D>> with_new_gaps(const PairedBodies<D>& all, const PairedBodies<D>& chosen);

/// Whether a displacement takes a pair that is not among `chosen` through its bound.
template <int D>
bool touches_elsewhere(const Nodes<D>& nodes, const Model<D>& model, const PairedBodies<D>& all,
                       const PairedBodies<D>& chosen, const std::vector<double>& u);

}  // namespace signorini
