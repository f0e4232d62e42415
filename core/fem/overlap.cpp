#include "core/fem/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/base/dot.hpp"
#include "core/fem/nearest_on_face.hpp"
#include "core/fem/paired_sides.hpp"
#include "core/mesh/point_tree.hpp"

namespace signorini {
namespace {

// Faces are equally near up to this part of the distance: those at an edge or a vertex that is the nearest point.
constexpr double as_near = 1e-9;
// A vertex is not behind a face whose nearest point is so much farther away than its plane: in the corner of a cube it
// is farther by the square root of 3.
constexpr double beside = 1.8;

template <int D>
using Box = typename PointTree<D>::Box;

/// Faces to be asked for the nearest one.
template <int D>
class FaceTree {
 public:
  FaceTree(const Mesh<D>& mesh, std::span<const Point<D>> points, std::span<const Index> faces) : faces_(faces) {
    for (const Index f : faces) {
      auto& corner = corner_.emplace_back();
      for (int i = 0; i < D; ++i) corner[i] = points[mesh.boundary[f].vertices[i]];
      normalise(normal_.emplace_back(area_normal(corner)));
      Point<D> low = corner[0], high = corner[0];
      for (const Point<D>& x : corner)
        for (int k = 0; k < D; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
      middle_.push_back(midpoint<D>(low, high));
      half_.push_back(difference<D>(high, middle_.back()));
    }
    std::vector<Index> numbers(faces.size());
    std::iota(numbers.begin(), numbers.end(), Index{0});
    tree_.emplace(middle_, half_, std::move(numbers));
  }

  struct Nearest {
    Index face = -1;
    double distance = infinity;
    double height = 0;  ///< in front of the face; negative: behind
  };

  /// Of faces that are equally near the one that x is least beside: its side is the one that counts.
  Nearest nearest(const Point<D>& x) const {
    Nearest out;
    const auto near = [&](const Box<D>& box) {
      const double limit = out.distance * (1 + as_near);
      return PointTree<D>::squared_distance(box, x) <= limit * limit;
    };
    tree_->search_nearest(x, near, [&](Index k) {
      const double far = length<D>(difference<D>(x, nearest_on_face(corner_[k], x)));
      if (far > out.distance * (1 + as_near)) return;
      const double height = dot(difference<D>(x, corner_[k][0]), normal_[k]);
      if (far < out.distance * (1 - as_near) || std::abs(height) > std::abs(out.height))
        out = {faces_[k], std::min(far, out.distance), height};
    });
    return out;
  }

 private:
  std::span<const Index> faces_;
  std::vector<std::array<Point<D>, D>> corner_;
  std::vector<Point<D>> normal_, middle_, half_;
  std::optional<PointTree<D>> tree_;
};

/// Vertices of faces that are inside a box, each with the longest face that it is of.
template <int D>
std::vector<std::pair<Index, Index>> vertices_inside(const Mesh<D>& mesh, std::span<const Point<D>> points,
                                                     const std::vector<Index>& faces,
                                                     const std::vector<Index>& around) {
  Box<D> box;
  box.low.fill(infinity);
  box.high.fill(-infinity);
  for (const Index f : around)
    for (const Index v : mesh.boundary[f].vertices)
      for (int k = 0; k < D; ++k) {
        box.low[k] = std::min(box.low[k], points[v][k]);
        box.high[k] = std::max(box.high[k], points[v][k]);
      }
  std::vector<std::pair<Index, Index>> out;
  for (const Index f : faces)
    for (const Index v : mesh.boundary[f].vertices) {
      bool inside = true;
      for (int k = 0; k < D; ++k) inside = inside && points[v][k] > box.low[k] && points[v][k] < box.high[k];
      if (inside) out.emplace_back(v, f);
    }
  const auto size = [&](Index f) { return longest_edge(mesh, mesh.boundary[f]); };
  std::ranges::sort(out, [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : size(a.second) > size(b.second);
  });
  const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

}  // namespace

template <int D>
Overlap<D> find_overlap(const Mesh<D>& mesh, std::span<const Point<D>> points, const BodyFaces& slave,
                        const BodyFaces& master, const std::function<double(const Point<D>&, Index)>& added) {
  Overlap<D> out;
  const auto look = [&](const BodyFaces& one, const BodyFaces& other, bool of_slave) {
    const auto candidates = vertices_inside<D>(mesh, points, one.touching, other.all);
    if (candidates.empty()) return;
    const FaceTree<D> body(mesh, points, other.all), touching(mesh, points, other.touching);
    for (const auto& [v, face] : candidates) {
      if (body.nearest(points[v]).height >= 0) continue;
      const auto found = touching.nearest(points[v]);
      const Index slave_face = of_slave ? face : found.face;
      // In a corner the faces that meet there count, not the way to the corner; and none that it is not behind.
      if (found.distance > beside * std::abs(found.height)) continue;
      const double depth = std::abs(found.height) - (added ? added(points[v], slave_face) : 0);
      if (depth > out.depth) out = {depth, points[v], slave_face};
    }
  };
  look(slave, master, true);
  look(master, slave, false);
  return out;
}

template Overlap<2> find_overlap<2>(const Mesh<2>&, std::span<const Point<2>>, const BodyFaces&, const BodyFaces&,
                                    const std::function<double(const Point<2>&, Index)>&);
template Overlap<3> find_overlap<3>(const Mesh<3>&, std::span<const Point<3>>, const BodyFaces&, const BodyFaces&,
                                    const std::function<double(const Point<3>&, Index)>&);

}  // namespace signorini
