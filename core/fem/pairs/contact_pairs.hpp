#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "core/fem/pairs/paired_sides.hpp"

namespace signorini {

/// The sides of one obstacle between bodies that may touch, coupled on one mesh.
template <int D>
class ContactPair {
 public:
  /// Keeps references.
  /// @param points where the vertices of the mesh are; none: as the mesh has them
  /// @param left_out vertices that are to be no slave nodes, see leave_out(); ascending
  ContactPair(const Nodes<D>& nodes, const Model<D>& model, const std::vector<FixedDirections<D>>& fixes,
              Index obstacle, PairedFaces faces, std::vector<Point<D>> points, std::vector<Index> left_out);

  Index obstacle() const { return obstacle_; }
  const ObstacleTerm<D>& term() const { return model_->obstacles[obstacle_]; }
  const MortarCoupling<D>& coupling() const { return found_; }

  /// Outer unit normal of the slave at its k-th node; within planes of symmetry.
  Point<D> normal(Index k) const;
  /// What is free of that; nothing: no condition holds there.
  std::optional<FreeNormal<D>> free(Index k) const;
  /// Whether a vertex is a slave node.
  bool has(Index vertex) const { return std::ranges::binary_search(found_.node, vertex); }

  /// Some more vertices are no slave nodes: what they are a part of goes to their neighbours. But for faces of elements
  /// all of whose vertices are such: these have() them still.
  void leave_out(std::vector<Index> vertices);

 private:
  void couple();

  const Nodes<D>* nodes_;
  const Model<D>* model_;
  const std::vector<FixedDirections<D>>* fixes_;
  Index obstacle_;
  PairedFaces faces_;
  std::vector<Point<D>> points_;
  std::vector<Index> left_out_;
  MortarCoupling<D> found_;
};

/// Each node becomes the slave of one pair at most: of several the one that covers most of it has it, and the others
/// leave it out. So do nodes at which several bodies meet carry no multiplier of their own but in one pair (Puso, A 3D
/// mortar method for solid mechanics, Int. J. Numer. Meth. Engng. 59, 2004). Where faces have no other nodes that is
/// not so.
template <int D>
void share_slaves(std::vector<ContactPair<D>>& pairs);

}  // namespace signorini
