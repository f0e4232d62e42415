#pragma once
#include "core/fem/conditions/walls.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/recovery/contact.hpp"

namespace signorini {

/// Else it is one of a scalar that acts on the body.
template <int B>
bool acts_on_faces(const ObstacleTerm<B>& term) {
  return B > 1 || term.on;
}

/// The faces that an obstacle acts on, as its nodes see them. At a node only those count that face the obstacle:
/// whose outer normal is within 60 degrees of what presses; where there is none all do.
template <int D, int B>
class ContactSurface {
 public:
  ContactSurface(const Nodes<D>& nodes, const Model<B>& model, Index obstacle);

  /// See acts_on_faces(): areas are volumes.
  bool in_body() const { return !volumes_.empty(); }

  /// See ContactNode::area.
  double area(const ContactNode<B>& node) const;
  /// Where the mean of a linear pressure over the node's basis function is its value: the centroid of that function on
  /// the mesh.
  Point<D> middle(const ContactNode<B>& node) const;
  /// The mean of what has a value at points, weighted by the node's basis function.
  template <class Value>
  double mean(const ContactNode<B>& node, const Value& value) const {
    double sum = 0;
    const double area = each_point(node, [&](const Point<D>& at, double weight) { sum += weight * value(at); });
    return sum / area;
  }
  /// Numbers in Mesh::boundary of the faces that count at a node.
  std::vector<Index> faces(const ContactNode<B>& node) const;
  /// All of them that the obstacle acts on.
  const std::vector<Index>& all_faces() const { return surface_.faces; }
  Plane plane() const { return plane_; }
  /// Planes that fixes make planes of symmetry beside the surface.
  const std::vector<Flat<D>>& walls() const { return walls_; }
  bool lies_on(const Flat<D>& wall, Index node) const { return signorini::lies_on<D>(wall, nodes_.at(node), extent_); }

 private:
  bool counts(Index face, const ContactNode<B>& node) const;

  /// Calls use(point, weight) for the points that stand for the node's basis function; the weights sum to what is
  /// returned, its area.
  template <class Use>
  double each_point(const ContactNode<B>& node, const Use& use) const {
    double area = 0;
    for (const Index f : faces(node)) {
      const double share = face_share(nodes_, f, node.vertex, plane_);
      for (const auto& [at, weight] : share_points(nodes_, f, node.vertex, plane_)) use(at, share * weight);
      area += share;
    }
    return area;
  }

  const Nodes<D>& nodes_;
  const Plane plane_;
  Surface<D> surface_;
  std::vector<Flat<D>> walls_;
  const double extent_;
  std::vector<double> volumes_;  // per node, where the obstacle acts on the body
};

}  // namespace signorini
