#pragma once
#include "core/fem/contact.hpp"
#include "core/fem/select.hpp"

namespace signorini {

/// The faces that an obstacle acts on, as its nodes see them. At a node only those count that face the obstacle:
/// whose outer normal is within 60 degrees of what presses; where there is none all do.
template <int D, int B>
class ContactSurface {
 public:
  ContactSurface(const Nodes<D>& nodes, const Model<B>& model, Index obstacle);

  /// A scalar obstacle without faces: it acts on the body, and areas are volumes.
  bool in_body() const { return !volumes_.empty(); }

  /// See ContactNode::area.
  double area(const ContactNode<B>& node) const;
  /// Where the mean of a linear pressure over the node's hat function is its value: the centroid of that function.
  Point<D> middle(const ContactNode<B>& node) const;
  /// Numbers in Mesh::boundary of the faces that count at a node.
  std::vector<Index> faces(const ContactNode<B>& node) const;
  Plane plane() const { return plane_; }

 private:
  bool counts(Index face, const ContactNode<B>& node) const;

  const Nodes<D>& nodes_;
  const Plane plane_;
  Surface<D> surface_;
  std::vector<double> volumes_;  // per node, where the obstacle acts on the body
};

}  // namespace signorini
