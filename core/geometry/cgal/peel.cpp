#include "core/geometry/cgal/peel.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include "core/mesh/boundary.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

using Edge = std::array<Index, 2>;

Point<3> normal(const Mesh<3>& mesh, const Face<3>& face) {
  const auto& [a, b, c] = face.vertices;
  const Point<3> u = difference<3>(mesh.points[b], mesh.points[a]), v = difference<3>(mesh.points[c], mesh.points[a]);
  const Point<3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double l = length<3>(n);
  return {n[0] / l, n[1] / l, n[2] / l};
}

bool lie_flat(const Mesh<3>& mesh, const Face<3>& one, const Face<3>& two) {
  const Point<3> n = normal(mesh, one), m = normal(mesh, two);
  return n[0] * m[0] + n[1] * m[1] + n[2] * m[2] > std::cos(5 * std::numbers::pi / 180);
}

/// The vertices of one face that another one has, too.
Edge common_edge(const Face<3>& one, const Face<3>& two) {
  Edge edge{};
  std::size_t k = 0;
  for (const Index v : one.vertices)
    if (std::ranges::find(two.vertices, v) != two.vertices.end()) edge[k++] = v;
  return sorted(edge);
}

/// The edge of an element that is in neither of two of its faces whole: it joins their free vertices.
Edge free_edge(const std::array<Index, 4>& element, const Face<3>& one, const Face<3>& two) {
  Edge edge{};
  std::size_t k = 0;
  for (const Index v : element) {
    const bool in_one = std::ranges::find(one.vertices, v) != one.vertices.end();
    const bool in_two = std::ranges::find(two.vertices, v) != two.vertices.end();
    if (in_one != in_two) edge[k++] = v;
  }
  return sorted(edge);
}

}  // namespace

void peel_slivers(Mesh<3>& mesh, const std::vector<CreaseEdge>& creases) {
  std::set<Edge> kept_edges;
  for (const CreaseEdge& crease : creases) kept_edges.insert(sorted(crease.ends));
  std::set<Edge> edges;  // of the boundary
  std::vector<std::vector<Index>> faces_of_element(mesh.elements.size());
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
    const auto& face = mesh.boundary[f];
    for (std::size_t k = 0; k < 3; ++k) edges.insert(sorted(Edge{face.vertices[k], face.vertices[(k + 1) % 3]}));
    faces_of_element[face.element].push_back(static_cast<Index>(f));
  }
  std::vector<std::array<Index, 4>> kept;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& faces = faces_of_element[e];
    // The boundary stays a manifold only if the edge that comes up is not on it elsewhere.
    const bool peeled =
        faces.size() == 2 && lie_flat(mesh, mesh.boundary[faces[0]], mesh.boundary[faces[1]]) &&
        !kept_edges.contains(common_edge(mesh.boundary[faces[0]], mesh.boundary[faces[1]])) &&
        edges.insert(free_edge(mesh.elements[e], mesh.boundary[faces[0]], mesh.boundary[faces[1]])).second;
    if (!peeled) kept.push_back(mesh.elements[e]);
  }
  if (kept.size() == mesh.elements.size()) return;
  mesh.elements = std::move(kept);
  mesh.boundary = find_boundary<3>(mesh.vertices(), mesh.elements);
}

}  // namespace signorini::geometry
