#include "core/geometry/cgal/creases.hpp"

#include <cmath>

#include "core/base/dot.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

class Creases {
 public:
  Creases(const TriangleSurface& surface, double angle) : surface_(surface), cosine_(std::cos(angle)) {
    sharp_.resize(surface.points().size());
    for (std::size_t t = 0; t < surface.triangles().size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index other = surface.neighbours()[t][k];
        if (other < static_cast<Index>(t)) continue;  // every edge once
        const Point<3> n = normal(t), m = normal(static_cast<std::size_t>(other));
        if (dot(n, m) >= cosine_ * length<3>(n) * length<3>(m)) continue;
        const Index a = surface.triangles()[t][(k + 1) % 3], b = surface.triangles()[t][(k + 2) % 3];
        sharp_[a].push_back({b, false});
        sharp_[b].push_back({a, false});
      }
  }

  std::vector<Polyline> polylines() {
    for (std::size_t v = 0; v < sharp_.size(); ++v)
      if (corner(static_cast<Index>(v))) follow_all(static_cast<Index>(v));
    for (std::size_t v = 0; v < sharp_.size(); ++v) follow_all(static_cast<Index>(v));  // what is left are loops
    return std::move(lines_);
  }

 private:
  struct End {
    Index to;
    bool used;
  };

  Point<3> normal(std::size_t t) const {
    const auto& [a, b, c] = surface_.triangles()[t];
    const Point<3> u = edge(a, b), v = edge(a, c);
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  }
  Point<3> edge(Index a, Index b) const { return difference<3>(surface_.points()[b], surface_.points()[a]); }

  bool corner(Index v) const {
    const auto& ends = sharp_[v];
    if (ends.empty()) return false;
    if (ends.size() != 2) return true;
    const Point<3> in = edge(ends[0].to, v), out = edge(v, ends[1].to);
    return dot(in, out) < cosine_ * length<3>(in) * length<3>(out);
  }

  void follow_all(Index start) {
    for (std::size_t k = 0; k < sharp_[start].size(); ++k)
      if (!sharp_[start][k].used) follow(start, k);
  }

  void follow(Index start, std::size_t k) {
    Polyline& line = lines_.emplace_back();
    line.push_back(surface_.points()[start]);
    for (Index v = start; k < sharp_[v].size();) {
      sharp_[v][k].used = true;
      const Index next = sharp_[v][k].to;
      for (End& end : sharp_[next])
        if (end.to == v) end.used = true;
      line.push_back(surface_.points()[next]);
      v = next;
      if (v == start || corner(v)) break;
      for (k = 0; k < sharp_[v].size() && sharp_[v][k].used;) ++k;
    }
  }

  const TriangleSurface& surface_;
  double cosine_;
  std::vector<std::vector<End>> sharp_;  // per vertex its sharp edges
  std::vector<Polyline> lines_;
};

}  // namespace

std::vector<Polyline> find_creases(const TriangleSurface& surface, double angle) {
  return Creases(surface, angle).polylines();
}

}  // namespace signorini::geometry
