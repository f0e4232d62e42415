#include "core/mesh/hanging.hpp"

#include <cmath>

#include "core/base/dot.hpp"
#include "core/mesh/point_tree.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

constexpr double tolerance = 1e-9;

/// A boundary face in units of its longest edge, its first corner at the origin: free of overflow.
template <int D>
class ScaledFace {
 public:
  ScaledFace(const Mesh<D>& mesh, const Face<D>& face) : origin_(mesh.points[face.vertices[0]]) {
    for (int i = 1; i < D; ++i) edge_[i - 1] = difference<D>(mesh.points[face.vertices[i]], origin_);
    for (int i = 0; i < D - 1; ++i) {
      size_ = std::max(size_, length<D>(edge_[i]));
      for (int j = 0; j < i; ++j) size_ = std::max(size_, length<D>(difference<D>(edge_[i], edge_[j])));
    }
    for (auto& e : edge_)
      for (double& c : e) c /= size_;
    if constexpr (D == 2)
      normal_ = {-edge_[0][1], edge_[0][0]};
    else
      normal_ = {edge_[0][1] * edge_[1][2] - edge_[0][2] * edge_[1][1],
                 edge_[0][2] * edge_[1][0] - edge_[0][0] * edge_[1][2],
                 edge_[0][0] * edge_[1][1] - edge_[0][1] * edge_[1][0]};
    const double norm = length<D>(normal_);
    for (double& c : normal_) c /= norm;
  }

  /// Whether the box comes near the face's own box and plane.
  bool meets(const typename PointTree<D>::Box& box) const {
    double middle = 0, reach = tolerance;
    for (int k = 0; k < D; ++k) {
      const double low = (box.low[k] - origin_[k]) / size_, high = (box.high[k] - origin_[k]) / size_;
      double least = 0, most = 0;
      for (const auto& e : edge_) least = std::min(least, e[k]), most = std::max(most, e[k]);
      if (low > most + tolerance || high < least - tolerance) return false;
      middle += normal_[k] * 0.5 * (low + high);
      reach += std::abs(normal_[k]) * 0.5 * (high - low);
    }
    return std::abs(middle) <= reach;
  }

  bool holds_inside(const Point<D>& point) const {
    Point<D> x = difference<D>(point, origin_);
    for (double& c : x) c /= size_;
    if (std::abs(dot<D>(normal_, x)) > tolerance || length<D>(x) <= tolerance) return false;
    for (const auto& e : edge_)
      if (length<D>(difference<D>(x, e)) <= tolerance) return false;
    if constexpr (D == 2) {
      const double s = dot<2>(x, edge_[0]);
      return s > 0 && s < 1;
    } else {
      return std::min({height(x, {}, edge_[0]), height(x, edge_[0], edge_[1]), height(x, edge_[1], {})}) >= -tolerance;
    }
  }

 private:
  /// Distance of x from the line through a and b in the face's plane, positive on the side of the face.
  double height(const Point<D>& x, const Point<D>& a, const Point<D>& b) const {
    const Point<D> along = difference<D>(b, a), from = difference<D>(x, a);
    return determinant<D>({normal_, along, from}) / length<D>(along);
  }

  Point<D> origin_, normal_;
  std::array<Point<D>, D - 1> edge_;
  double size_ = 0;
};

template <int D>
std::vector<Index> boundary_vertices(const Mesh<D>& mesh) {
  std::vector<Index> vertices;
  for (const Face<D>& face : mesh.boundary) vertices.insert(vertices.end(), face.vertices.begin(), face.vertices.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace

template <int D>
std::vector<HangingVertex> find_hanging_vertices(const Mesh<D>& mesh) {
  const PointTree<D> tree(mesh.points, boundary_vertices(mesh));
  std::vector<HangingVertex> found;
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
    const ScaledFace<D> face(mesh, mesh.boundary[f]);
    tree.search([&](const typename PointTree<D>::Box& box) { return face.meets(box); },
                [&](Index v) {
                  if (face.holds_inside(mesh.points[v])) found.push_back({v, static_cast<Index>(f)});
                });
  }
  std::ranges::stable_sort(found, {}, &HangingVertex::vertex);
  const auto same = [](const HangingVertex& a, const HangingVertex& b) { return a.vertex == b.vertex; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

template std::vector<HangingVertex> find_hanging_vertices(const Mesh<2>&);
template std::vector<HangingVertex> find_hanging_vertices(const Mesh<3>&);

}  // namespace signorini
