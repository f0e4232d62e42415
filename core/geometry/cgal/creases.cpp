#include "core/geometry/cgal/creases.hpp"

#include <cmath>

#include "core/base/dot.hpp"
#include "core/geometry/edges.hpp"
#include "core/geometry/groups.hpp"
#include "core/geometry/tips.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

constexpr double digits = 1e-6;  // of the size of all: what files round away

class CreaseFinder {
 public:
  CreaseFinder(const TriangleSurface& surface, double crease)
      : points_(surface.points()), triangles_(surface.triangles()), crease_(crease), sharp_(points_.size()) {
    const auto joints = find_joints<3>(static_cast<Index>(points_.size()), triangles_);
    const Edges edges = find_edges<3>(points_, triangles_, joints, crease);
    Groups pieces(triangles_.size());
    std::vector<Index> bent;  // faces beside those that they are not in one plane with
    for (Index i = 0; i < static_cast<Index>(joints.beyond.size()); ++i) {
      const Index other = joints.beyond[i];
      if (other < i) continue;  // every edge once
      if (edges.sharp[joints.number[i]] == 0) {
        pieces.join(i / 3, other / 3);
        if (height(i, other) > digits || height(other, i) > digits) bent.push_back(i / 3);
        continue;
      }
      const auto [a, b] = joint_of<3>(triangles_[i / 3], i % 3);
      sharp_[a].push_back({b, false});
      sharp_[b].push_back({a, false});
    }
    const auto tips = find_tips(points_, triangles_, joints, edges.sharp, crease);
    for (std::size_t v = 0; v < tips.size(); ++v)
      if (tips[v] != 0) out_.tips.push_back(points_[v]);
    Index count = 0;
    const auto piece = pieces.numbered(count);
    std::vector<std::uint8_t> curved(static_cast<std::size_t>(count), 0);
    for (const Index f : bent) curved[piece[f]] = 1;
    for (const Index p : piece) out_.curved_piece.push_back(curved[p] != 0 ? p : -1);
  }

  Creases run() {
    for (std::size_t v = 0; v < sharp_.size(); ++v)
      if (is_corner(static_cast<Index>(v))) follow_all(static_cast<Index>(v));
    for (std::size_t v = 0; v < sharp_.size(); ++v) follow_all(static_cast<Index>(v));  // what is left are loops
    return std::move(out_);
  }

 private:
  struct End {
    Index to;
    bool used;
  };

  /// Of the tip of one face, as faces and tips, over the plane of another one.
  double height(Index of, Index over) const {
    const auto& [a, b, c] = triangles_[over / 3];
    const Point<3> n = cross(edge(a, b), edge(a, c));
    return std::abs(dot(n, edge(a, triangles_[of / 3][of % 3]))) / length<3>(n);
  }
  Point<3> edge(Index a, Index b) const { return difference<3>(points_[b], points_[a]); }
  static double angle(const Point<3>& u, const Point<3>& v) { return std::atan2(length<3>(cross(u, v)), dot(u, v)); }

  bool is_corner(Index v) const {
    const auto& ends = sharp_[v];
    return !ends.empty() && (ends.size() != 2 || angle(edge(ends[0].to, v), edge(v, ends[1].to)) > crease_);
  }

  void follow_all(Index start) {
    for (std::size_t k = 0; k < sharp_[start].size(); ++k)
      if (!sharp_[start][k].used) follow(start, k);
  }

  void follow(Index start, std::size_t k) {
    Polyline& line = out_.lines.emplace_back();
    line.push_back(points_[start]);
    for (Index v = start; k < sharp_[v].size();) {
      sharp_[v][k].used = true;
      const Index next = sharp_[v][k].to;
      for (End& end : sharp_[next])
        if (end.to == v) end.used = true;
      line.push_back(points_[next]);
      v = next;
      if (v == start || is_corner(v)) break;
      for (k = 0; k < sharp_[v].size() && sharp_[v][k].used;) ++k;
    }
  }

  const std::vector<Point<3>>& points_;
  const std::vector<std::array<Index, 3>>& triangles_;
  double crease_;
  std::vector<std::vector<End>> sharp_;  // per vertex its sharp edges
  Creases out_;
};

}  // namespace

Creases find_creases(const TriangleSurface& surface, double crease) { return CreaseFinder(surface, crease).run(); }

}  // namespace signorini::geometry
