#include "core/mesh/build.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/mesh/bends.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/subsimplices.hpp"
#include "core/mesh/validate.hpp"

namespace signorini {
namespace {

constexpr double straight = 1e-9;  // of an edge's length: what its middle may be off

template <int D>
void orient(Mesh<D>& mesh) {
  std::array<int, D + 1> was;
  for (int i = 0; i <= D; ++i) was[i] = i;
  std::swap(was[1], was[D]);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (relative_volume<D>(corners<D>(mesh.points, mesh.elements[e])) < 0) {
      flip<D>(mesh.elements[e]);
      if (!mesh.bends.empty()) mesh.bends[e] = permuted<D>(mesh.bends[e], was);
    }
}

/// What the points in the middle of edges say, the same for all elements around an edge.
template <int D>
std::vector<Bends<D>> find_bends(const RawMesh<D>& raw, std::string_view place) {
  constexpr auto edges = simplex_edges<D>();
  if (std::ranges::all_of(raw.middle,
                          [](const auto& m) { return std::ranges::all_of(m, [](Index v) { return v < 0; }); }))
    return {};
  const Numbering number = number_edges<D>(static_cast<Index>(raw.points.size()), raw.elements);
  std::vector<Point<D>> bend(number.distinct, Point<D>{});
  std::vector<Index> through(number.distinct, -1);
  for (std::size_t e = 0; e < raw.elements.size(); ++e)
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Index m = raw.middle[e][k], edge = number.number[e * edges.size() + k];
      if (m < 0) continue;
      const Point<D>&a = raw.points[raw.elements[e][edges[k][0]]], &b = raw.points[raw.elements[e][edges[k][1]]];
      if (through[edge] >= 0 && raw.points[through[edge]] != raw.points[m])
        input_error(place, fmt::format("element {} has another node in the middle of the edge from ({}) to ({}) than "
                                       "one beside it: the mesh does not fit together there",
                                       raw.label.empty() ? static_cast<Offset>(e) : raw.label[e], fmt::join(a, ", "),
                                       fmt::join(b, ", ")));
      through[edge] = m;
      const Point<D> off = difference<D>(raw.points[m], midpoint<D>(a, b));
      const double far = length<D>(off);
      if (!std::isfinite(far))
        input_error(place, fmt::format("the edge from ({}) to ({}) goes through ({}), which is too far away",
                                       fmt::join(a, ", "), fmt::join(b, ", "), fmt::join(raw.points[m], ", ")));
      const double size = length<D>(difference<D>(a, b));
      if (far > size)  // half of it is half a circle
        input_error(place, fmt::format("the edge from ({}) to ({}) goes through ({}), which is farther from its middle "
                                       "than the edge is long; expected a node near the middle",
                                       fmt::join(a, ", "), fmt::join(b, ", "), fmt::join(raw.points[m], ", ")));
      if (far <= straight * size) continue;
      bend[edge] = off;
    }
  std::vector<Bends<D>> out(raw.elements.size());
  for (std::size_t e = 0; e < out.size(); ++e)
    for (std::size_t k = 0; k < edges.size(); ++k) out[e][k] = bend[number.number[e * edges.size() + k]];
  return out;
}

/// Gives the faces that are not flat a curve, and says which ones have straight edges at the file's word.
template <int D>
void mark_faces(Mesh<D>& mesh, const RawMesh<D>& raw) {
  if (mesh.bends.empty()) return;
  constexpr auto edges = simplex_edges<D>();
  mesh.curves.push_back({.kind = Curve<D>::Kind::elements});
  for (Face<D>& face : mesh.boundary) {
    const Simplex<D>& element = mesh.elements[face.element];
    const auto on_face = [&](int i) { return std::ranges::count(face.vertices, element[i]) > 0; };
    Point<D> normal;
    const Point<D> u = difference<D>(mesh.points[face.vertices[1]], mesh.points[face.vertices[0]]);
    if constexpr (D == 2)
      normal = {u[1], -u[0]};
    else
      normal = cross(u, difference<D>(mesh.points[face.vertices[2]], mesh.points[face.vertices[0]]));
    face.straight = std::ranges::all_of(raw.middle[face.element], [](Index v) { return v >= 0; });
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (!on_face(edges[k][0]) || !on_face(edges[k][1])) continue;
      const Point<D>& bend = mesh.bends[face.element][k];
      if (bend != Point<D>{}) face.straight = false;
      if (std::abs(dot(bend, normal)) > straight * length<D>(u) * length<D>(normal)) face.curve = 0;
    }
  }
}

template <int D>
void drop_unused_vertices(RawMesh<D>& raw) {
  std::vector<Index> number(raw.points.size(), -1);
  for (const auto& element : raw.elements)
    for (const Index v : element) number[v] = 0;
  Index used = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] == 0) {
      raw.points[used] = raw.points[v];
      number[v] = used++;
    }
  if (static_cast<std::size_t>(used) == raw.points.size()) return;

  raw.points.resize(used);
  for (auto& element : raw.elements)
    for (Index& v : element) v = number[v];
  for (FaceGroup<D>& group : raw.groups) {
    for (auto& face : group.faces)
      for (Index& v : face) v = number[v];
    std::erase_if(group.faces,
                  [](const auto& face) { return std::ranges::any_of(face, [](Index v) { return v < 0; }); });
  }
}

}  // namespace

template <int D>
Mesh<D> build_mesh(RawMesh<D> raw, std::string_view place) {
  Mesh<D> mesh;
  mesh.bends = find_bends(raw, place);
  drop_unused_vertices(raw);
  mesh.points = std::move(raw.points);
  mesh.elements = std::move(raw.elements);
  orient(mesh);
  validate(mesh, place, raw.label);
  mesh.boundary = find_boundary<D>(mesh.vertices(), mesh.elements);
  attach_parts(mesh, raw.groups);
  mark_faces(mesh, raw);
  return mesh;
}

template Mesh<2> build_mesh(RawMesh<2>, std::string_view);
template Mesh<3> build_mesh(RawMesh<3>, std::string_view);

}  // namespace signorini
