#include "core/geometry/cgal/reconnect.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

constexpr double sliver = 1e-3;           // of h^3, where a regular tetrahedron has 0.12
constexpr double least_gain = 1e-6;       // more than rounding makes
constexpr std::size_t largest_ring = 10;  // elements around an edge that may be removed

/// The elements around an edge: each has the ends of the edge and two vertices of the ring that follow each other.
struct Ring {
  std::array<Index, 2> edge;
  std::vector<Index> elements, vertices;
};

class Reconnection {
 public:
  explicit Reconnection(Mesh<3>& mesh) : mesh_(mesh), around_(mesh.points.size()) {
    for (Index e = 0; e < std::ssize(mesh.elements); ++e) note(e);
  }

  bool run() {
    bool any = false;
    for (std::size_t k = 0; k < mesh_.elements.size(); ++k)
      while (!gone(static_cast<Index>(k)) && quality(mesh_.elements[k]) < sliver && improve(static_cast<Index>(k)))
        any = true;
    if (any) std::erase_if(mesh_.elements, [](const Simplex<3>& element) { return element[0] < 0; });
    return any;
  }

 private:
  void note(Index e) {
    for (const Index v : mesh_.elements[e]) around_[v].push_back(e);
  }
  bool gone(Index e) const { return mesh_.elements[e][0] < 0; }
  double quality(const Simplex<3>& element) const { return relative_volume<3>(corners<3>(mesh_.points, element)); }

  /// Takes away the edge of an element whose removal leaves the best; false where none does any good.
  bool improve(Index e) {
    std::vector<Simplex<3>> best;
    Ring removed;
    double gain = least_gain;
    for (const auto& [i, k] : simplex_edges<3>()) {
      const std::optional<Ring> ring = ring_around(mesh_.elements[e][i], mesh_.elements[e][k]);
      if (!ring) continue;
      double before = infinity;
      for (const Index other : ring->elements) before = std::min(before, quality(mesh_.elements[other]));
      auto [after, fill] = best_fill(*ring);
      if (after - before <= gain) continue;
      gain = after - before;
      best = std::move(fill);
      removed = *ring;
    }
    for (const Index other : removed.elements) remove(other);
    for (const Simplex<3>& element : best) {
      mesh_.elements.push_back(element);
      note(static_cast<Index>(mesh_.elements.size()) - 1);
    }
    return !best.empty();
  }

  void remove(Index e) {
    for (const Index v : mesh_.elements[e]) std::erase(around_[v], e);
    mesh_.elements[e] = {-1, -1, -1, -1};
  }

  /// Nothing where the edge is on the boundary, or has too many elements around it.
  std::optional<Ring> ring_around(Index a, Index b) const {
    Ring ring{{a, b}, {}, {}};
    std::map<Index, Index> next;
    for (const Index e : around_[a]) {
      const Simplex<3>& element = mesh_.elements[e];
      if (std::ranges::find(element, b) == element.end()) continue;
      const auto [from, to] = opposite(element, a, b);
      ring.elements.push_back(e);
      next[from] = to;
    }
    if (ring.elements.size() > largest_ring || next.size() != ring.elements.size()) return {};
    Index v = next.begin()->first;
    do {
      ring.vertices.push_back(v);
      const auto found = next.find(v);
      if (found == next.end()) return {};
      v = found->second;
    } while (v != ring.vertices.front() && ring.vertices.size() < ring.elements.size());
    if (v != ring.vertices.front() || ring.vertices.size() != ring.elements.size()) return {};
    return ring;
  }

  /// The other two vertices, in the order in which they have the orientation of the element after a and b.
  static std::pair<Index, Index> opposite(const Simplex<3>& element, Index a, Index b) {
    std::array<int, 4> place{};
    int rest = 2;
    for (int i = 0; i < 4; ++i) place[element[i] == a ? 0 : element[i] == b ? 1 : rest++] = i;
    int inversions = 0;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < i; ++k) inversions += place[k] > place[i];
    const Index u = element[place[2]], v = element[place[3]];
    return inversions % 2 == 0 ? std::pair(u, v) : std::pair(v, u);
  }

  /// Of all ways to divide the polygon of the ring into triangles, each of which makes a tetrahedron with either end of
  /// the edge, the one whose worst tetrahedron is best (Klincsek 1980).
  std::pair<double, std::vector<Simplex<3>>> best_fill(const Ring& ring) const {
    const std::size_t n = ring.vertices.size();
    std::vector<std::vector<double>> worst(n, std::vector<double>(n, infinity));
    std::vector<std::vector<std::size_t>> apex(n, std::vector<std::size_t>(n, 0));
    for (std::size_t span = 2; span < n; ++span)
      for (std::size_t i = 0; i + span < n; ++i) {
        const std::size_t j = i + span;
        worst[i][j] = -infinity;
        for (std::size_t k = i + 1; k < j; ++k) {
          const auto [lower, upper] = pair_on(ring, i, k, j);
          const double found = std::min({worst[i][k], worst[k][j], quality(lower), quality(upper)});
          if (found <= worst[i][j]) continue;
          worst[i][j] = found;
          apex[i][j] = k;
        }
      }
    std::vector<Simplex<3>> fill;
    collect(ring, apex, 0, n - 1, fill);
    return {worst[0][n - 1], fill};
  }

  static std::pair<Simplex<3>, Simplex<3>> pair_on(const Ring& ring, std::size_t i, std::size_t k, std::size_t j) {
    const Index u = ring.vertices[i], v = ring.vertices[k], w = ring.vertices[j];
    return {{u, w, v, ring.edge[0]}, {u, v, w, ring.edge[1]}};
  }

  static void collect(const Ring& ring, const std::vector<std::vector<std::size_t>>& apex, std::size_t i, std::size_t j,
                      std::vector<Simplex<3>>& fill) {
    if (j < i + 2) return;
    const std::size_t k = apex[i][j];
    const auto [lower, upper] = pair_on(ring, i, k, j);
    fill.push_back(lower);
    fill.push_back(upper);
    collect(ring, apex, i, k, fill);
    collect(ring, apex, k, j, fill);
  }

  Mesh<3>& mesh_;
  std::vector<std::vector<Index>> around_;  // elements, per vertex
};

}  // namespace

bool replace_flat_elements(Mesh<3>& mesh) {
  const auto is_flat = [&](const Simplex<3>& element) {
    return relative_volume<3>(corners<3>(mesh.points, element)) < sliver;
  };
  return std::ranges::any_of(mesh.elements, is_flat) && Reconnection(mesh).run();
}

}  // namespace signorini::geometry
