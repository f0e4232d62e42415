#include "core/geometry/interfaces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/base/dot.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/red_refinement.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/subsimplices.hpp"

namespace signorini::geometry {
namespace {

constexpr double on_edge = 1e-9;  // of an edge's length

template <int D>
Point<D> normal_of(const Mesh<D>& mesh, const std::array<Index, D>& face) {
  const Point<D> u = difference<D>(mesh.points[face[1]], mesh.points[face[0]]);
  Point<D> n;
  if constexpr (D == 2)
    n = {u[1], -u[0]};
  else
    n = cross(u, difference<D>(mesh.points[face[2]], mesh.points[face[0]]));
  const double size = length<D>(n);
  for (double& x : n) x /= size;
  return n;
}

/// Calls use(element, corner opposite, element beyond) for every inner face, seen from the region with the smaller
/// number.
template <int D, class Use>
void each_inner_face(const Mesh<D>& mesh, const Use& use) {
  const Numbering number = number_faces<D>(mesh.vertices(), mesh.elements);
  std::vector<Offset> first(static_cast<std::size_t>(number.distinct), -1);
  for (std::size_t i = 0; i < number.number.size(); ++i) {
    Offset& other = first[number.number[i]];
    if (other < 0) {
      other = static_cast<Offset>(i);
      continue;
    }
    auto a = static_cast<std::size_t>(other), b = i;
    if (mesh.region[a / (D + 1)] > mesh.region[b / (D + 1)]) std::swap(a, b);
    use(static_cast<Index>(a / (D + 1)), static_cast<int>(a % (D + 1)), static_cast<Index>(b / (D + 1)));
  }
}

/// What edges of inner faces are on.
template <int D>
struct OnEdge {
  std::array<Index, 2> ends{-1, -1};
  std::vector<const Curve<D>*> shapes;
  std::vector<Flat<D>> planes;
  std::optional<Point<D>> on_patch;
  bool given = false;  ///< by a curved boundary
};

template <int D>
class Bender {
 public:
  Bender(Mesh<D>& mesh, const Mesh<D>& inner)
      : mesh_(mesh), inner_(inner), edges_(number_edges<D>(mesh.vertices(), mesh.elements)), on_(edges_.distinct) {}

  void run() {
    for (std::size_t f = 0; f < inner_.boundary.size(); ++f) add_inner(f);
    for (const Face<D>& face : mesh_.boundary) add_outer(face);
    std::vector<Point<D>> bend(static_cast<std::size_t>(edges_.distinct), Point<D>{});
    bool any = false;
    for (std::size_t k = 0; k < on_.size(); ++k) {
      if (on_[k].ends[0] < 0 || on_[k].given) continue;
      const Point<D>&a = mesh_.points[on_[k].ends[0]], &b = mesh_.points[on_[k].ends[1]];
      const double size = length<D>(difference<D>(a, b));
      const Point<D> middle = midpoint<D>(a, b), off = difference<D>(place(on_[k], middle, size), middle);
      if (length<D>(off) <= on_edge * size) continue;
      bend[k] = off;
      any = true;
    }
    if (!any) return;
    if (mesh_.bends.empty()) mesh_.bends.resize(mesh_.elements.size(), Bends<D>{});
    constexpr auto ends = simplex_edges<D>();
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
      for (std::size_t k = 0; k < ends.size(); ++k)
        if (const Point<D>& off = bend[edges_.number[e * ends.size() + k]]; off != Point<D>{}) mesh_.bends[e][k] = off;
  }

 private:
  /// Calls use(edge, first end, second end) for the edges of a face, with its ends as corners of the face.
  template <class Use>
  void each_edge(const Face<D>& face, const Use& use) const {
    constexpr auto ends = simplex_edges<D>();
    const Simplex<D>& element = mesh_.elements[face.element];
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const auto at = [&](int i) {
        return static_cast<int>(std::ranges::find(face.vertices, element[ends[k][i]]) - face.vertices.begin());
      };
      if (at(0) < D && at(1) < D) use(edges_.number[face.element * ends.size() + k], at(0), at(1));
    }
  }

  void add_inner(std::size_t f) {
    const Face<D>& face = inner_.boundary[f];
    each_edge(face, [&](Index edge, int a, int b) {
      OnEdge<D>& on = on_[edge];
      on.ends = {face.vertices[a], face.vertices[b]};
      if (face.curve < 0) {
        on.planes.push_back({mesh_.points[face.vertices[0]], normal_of<D>(mesh_, face.vertices)});
      } else if (const Curve<D>& curve = inner_.curves[face.curve]; curve.is_shape()) {
        if (std::ranges::count(on.shapes, &curve) == 0) on.shapes.push_back(&curve);
      } else if (curve.kind == CurveKind::patches) {
        std::array<double, D> middle{};
        middle[a] = middle[b] = 0.5;
        on.on_patch = (*inner_.patches)[f].at(middle);
      }
    });
  }

  void add_outer(const Face<D>& face) {
    if (D == 2) return;
    each_edge(face, [&](Index edge, int, int) {
      if (face.curve >= 0)
        on_[edge].given = true;
      else
        on_[edge].planes.push_back({mesh_.points[face.vertices[0]], normal_of<D>(mesh_, face.vertices)});
    });
  }

  Point<D> place(const OnEdge<D>& on, const Point<D>& middle, double reach) const {
    if (!on.shapes.empty()) return project<D>(on.shapes, on.planes, middle, reach);
    if (!on.on_patch) return middle;
    Point<D> out = *on.on_patch;
    for (const Flat<D>& plane : on.planes) {
      const double off = dot(difference<D>(out, plane.point), plane.normal);
      for (int k = 0; k < D; ++k) out[k] -= off * plane.normal[k];
    }
    return out;
  }

  Mesh<D>& mesh_;
  const Mesh<D>& inner_;
  Numbering edges_;
  std::vector<OnEdge<D>> on_;
};

}  // namespace

template <int D>
std::vector<std::array<Index, 2>> neighbouring_regions(const Mesh<D>& mesh) {
  std::set<std::array<Index, 2>> out;
  if (mesh.region.empty()) return {};
  each_inner_face(mesh, [&](Index e, int, Index g) {
    if (mesh.region[e] != mesh.region[g]) out.insert({mesh.region[e], mesh.region[g]});
  });
  return {out.begin(), out.end()};
}

template <int D>
std::vector<Face<D>> faces_between(const Mesh<D>& mesh, Index region, Index other) {
  std::vector<Face<D>> out;
  each_inner_face(mesh, [&](Index e, int tip, Index g) {
    if (mesh.region[e] != region || mesh.region[g] != other) return;
    Face<D> face{.vertices = {}, .element = e};
    for (int i = 0, k = 0; i <= D; ++i)
      if (i != tip) face.vertices[k++] = mesh.elements[e][i];
    const Point<D> up = difference<D>(mesh.points[mesh.elements[e][tip]], mesh.points[face.vertices[0]]);
    if (dot(normal_of<D>(mesh, face.vertices), up) > 0) std::swap(face.vertices[0], face.vertices[1]);
    out.push_back(face);
  });
  return out;
}

template <int D>
void bend_elements(Mesh<D>& mesh, const Mesh<D>& inner) {
  Bender<D>(mesh, inner).run();
}

#define SIGNORINI_INSTANTIATE(D)                                                   \
  template std::vector<Face<D>> faces_between(const Mesh<D>&, Index, Index);       \
  template std::vector<std::array<Index, 2>> neighbouring_regions(const Mesh<D>&); \
  template void bend_elements(Mesh<D>&, const Mesh<D>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini::geometry
