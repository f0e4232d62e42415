#pragma once
#include "core/fem/conditions/fixes.hpp"
#include "core/fem/conditions/paired_nodes.hpp"

namespace signorini {

/// What of a model is not said of single nodes: contact between bodies, ties and rigid parts. Of contact nodes whose
/// displacement is prescribed completely, or along the normal, are left out. Null where the model has none of these.
/// Error(Exit::input) that names the obstacle: sides that have faces in common; a slave all of whose nodes are
/// prescribed; bodies that overlap at the start by more than an element of the coarsest mesh. A node has one condition
/// of contact at most, see share_slaves().
/// @param fixes collect_fixes() of both
/// @param shift per obstacle of the model: sides find each other as if the slave's were moved by that, and may overlap
/// there; gaps are counted from the undeformed bodies on, as the unknowns are. Empty: none is
template <int D>
std::shared_ptr<const PairedBodies<D>> pair_bodies(const Nodes<D>& nodes, const Model<D>& model,
                                                   const std::vector<FixedDirections<D>>& fixes,
                                                   const std::vector<Point<D>>& shift = {});

/// Error(Exit::input) where conditions are left away at a node: to be asked on the finest mesh. On coarser ones that
/// makes a worse start.
template <int D>
void refuse_lost(const Nodes<D>& nodes, const Model<D>& model, const PairedBodies<D>& pairs);

/// By how much the slave of an obstacle has moved past the master.
template <int D>
struct Slip {
  Point<D> mean{};    ///< over the slave's nodes with a pair; where there is none, of all nodes of either side
  double length = 0;  ///< of the faces around them, the mean of their longest edges
};

/// Of an obstacle between bodies.
/// @param near pairs that count; where it has none of the obstacle all do
/// @param u a displacement, D per node
template <int D>
Slip<D> slip_past(const Nodes<D>& nodes, const Model<D>& model, Index obstacle, const PairedBodies<D>& all,
                  const PairedBodies<D>& near, const std::vector<double>& u);

/// Of all pairs those that nearly touch when the bodies are displaced by u (B per node, global coordinates), those that
/// a functional acts on wherever they are, and those that `also` has. Elsewhere jumps are of no use: there each body is
/// smoothed better by itself.
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

/// Whether a displacement takes a pair that is not among `chosen` through its bound, or a functional acts on one
/// anyway.
template <int D>
bool touches_elsewhere(const Nodes<D>& nodes, const Model<D>& model, const PairedBodies<D>& all,
                       const PairedBodies<D>& chosen, const std::vector<double>& u);

}  // namespace signorini
