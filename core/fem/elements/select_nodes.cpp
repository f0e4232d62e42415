#include "core/fem/elements/select_nodes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/base/error.hpp"
#include "core/fem/elements/element.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/connected.hpp"

namespace signorini {
namespace {

template <int D>
double apart(const Point<D>& a, const Point<D>& b) {
  return length<D>(difference<D>(a, b));
}

/// Per vertex whether it is one of the bodies of the selection's part.
template <int D>
std::vector<char> of_body(const Mesh<D>& mesh, const Selection& selection) {
  std::vector<char> out(mesh.points.size(), 1);
  if (!selection.part) return out;
  const std::vector<Index> body = connected_parts(mesh);
  std::set<Index> wanted;
  for (const Index f : faces_of(mesh, *selection.part, selection.origin))
    wanted.insert(body[mesh.boundary[f].vertices[0]]);
  for (std::size_t v = 0; v < out.size(); ++v) out[v] = wanted.contains(body[v]);
  return out;
}

template <int D>
Point<D> point_of(const Selection& selection) {
  Point<D> x;
  std::copy_n(selection.at.begin(), D, x.begin());
  return x;
}

/// The longest edge of elements around a vertex.
template <int D>
double size_around(const Nodes<D>& nodes, Index node) {
  double size = 0;
  with_order(nodes, [&](auto order) {
    for (const auto& vertices : nodes.template elements<order>()) {
      const auto around = nodes.of(vertices);
      if (std::ranges::find(around, node) == around.end()) continue;
      for (const Index p : around) size = std::max(size, apart<D>(nodes.at(p), nodes.at(node)));
    }
  });
  return size;
}

Selection part_alone(const Selection& selection, const std::optional<std::string>& part) {
  return {part, {}, selection.origin};
}

template <int D>
std::vector<Index> common_nodes(const Nodes<D>& nodes, const Selection& selection, double t) {
  const auto of = [&](const std::optional<std::string>& part) {
    return surface(nodes, select_faces(nodes.mesh(), part_alone(selection, part), t)).nodes;
  };
  std::vector<Index> out;
  std::ranges::set_intersection(of(selection.part), of(selection.other), std::back_inserter(out));
  if (out.empty())
    input_error(selection.origin, fmt::format("the parts '{}' and '{}' have no {} in common, expected two that meet",
                                              *selection.part, *selection.other, D == 2 ? "point" : "edge"));
  return out;
}

/// The edges of the faces of elements of a part.
template <int P>
std::vector<std::array<Index, element_nodes<1, P>>> edges_of(const Nodes<3>& nodes, const Selection& part) {
  std::vector<std::array<Index, element_nodes<1, P>>> out;
  constexpr auto edges = simplex_edges<2>();
  const std::vector<Index> faces = select_faces(nodes.mesh(), part, 0);
  for (std::size_t k = 0; k < faces.size(); k += static_cast<std::size_t>(nodes.faces_per_element())) {
    const auto face = nodes.template element_face<P>(faces[k]);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      auto& edge = out.emplace_back();
      const auto [first, last] = std::minmax(face[edges[e][0]], face[edges[e][1]]);
      edge[0] = first;
      edge[1] = last;
      if constexpr (P == 2) edge[2] = face[3 + e];
    }
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

template <int D>
NearVertex nearest_vertex(const Nodes<D>& nodes, const Selection& selection) {
  const Point<D> x = point_of<D>(selection);
  const std::vector<char> counts = of_body(nodes.mesh(), selection);
  NearVertex best{-1, 0};
  for (Index p = 0; p < nodes.size(); ++p) {
    if (nodes.ends(p)[0] != nodes.ends(p)[1] || !counts[nodes.vertex(p)]) continue;
    const double d = apart<D>(nodes.at(p), x);
    if (best.node < 0 || d < best.distance) best = {p, d};
  }
  if (const double size = size_around(nodes, best.node); best.distance > size)
    input_error(selection.origin,
                fmt::format("no vertex of the mesh is near ({}): the nearest one, ({}), is {:.3g} "
                            "away, where elements are {:.3g} long; expected a point of the body",
                            fmt::join(x, ", "), fmt::join(nodes.at(best.node), ", "), best.distance, size));
  return best;
}

template <int D>
std::vector<Index> select_nodes(const Nodes<D>& nodes, const Selection& selection, double t) {
  if (!selection.at.empty()) return {nearest_vertex(nodes, selection).node};
  if (selection.other) return common_nodes(nodes, selection, t);
  return surface(nodes, select_faces(nodes.mesh(), selection, t)).nodes;
}

template <int P>
std::vector<std::array<Index, element_nodes<1, P>>> common_edges(const Nodes<3>& nodes, const Selection& selection) {
  std::vector<std::array<Index, element_nodes<1, P>>> out;
  std::ranges::set_intersection(edges_of<P>(nodes, part_alone(selection, selection.part)),
                                edges_of<P>(nodes, part_alone(selection, selection.other)), std::back_inserter(out));
  if (out.empty())
    input_error(selection.origin, fmt::format("the parts '{}' and '{}' have no edge in common, expected two that meet",
                                              *selection.part, *selection.other));
  return out;
}

template NearVertex nearest_vertex(const Nodes<2>&, const Selection&);
template NearVertex nearest_vertex(const Nodes<3>&, const Selection&);
template std::vector<Index> select_nodes(const Nodes<2>&, const Selection&, double);
template std::vector<Index> select_nodes(const Nodes<3>&, const Selection&, double);
template std::vector<std::array<Index, 2>> common_edges<1>(const Nodes<3>&, const Selection&);
template std::vector<std::array<Index, 3>> common_edges<2>(const Nodes<3>&, const Selection&);

}  // namespace signorini
