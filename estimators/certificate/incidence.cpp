#include "estimators/certificate/incidence.hpp"

#include <algorithm>

#include "core/mesh/subsimplices.hpp"

namespace signorini {
namespace {

/// Where each list begins, of what is listed by `count` numbers below `lists`.
template <class Number>
std::vector<Offset> beginnings(Index lists, Offset count, const Number& number) {
  std::vector<Offset> first(static_cast<std::size_t>(lists) + 1);
  for (Offset i = 0; i < count; ++i) ++first[number(i) + 1];
  for (std::size_t p = 1; p < first.size(); ++p) first[p] += first[p - 1];
  return first;
}

}  // namespace

template <int D>
Incidence<D>::Incidence(const Mesh<D>& mesh) {
  const auto elements = static_cast<Offset>(mesh.elements.size());
  Numbering of_faces = number_faces<D>(mesh.vertices(), mesh.elements);
  face = std::move(of_faces.number);
  sides.resize(static_cast<std::size_t>(of_faces.distinct));
  for (Offset e = 0; e < elements; ++e)
    for (int k = 0; k <= D; ++k) {
      Sides& here = sides[face[e * (D + 1) + k]];
      const bool second = here.element[0] >= 0;
      here.element[second] = static_cast<Index>(e);
      here.opposite[second] = static_cast<std::int8_t>(k);
    }
  Numbering of_edges = number_edges<D>(mesh.vertices(), mesh.elements);
  edge = std::move(of_edges.number);
  edges = of_edges.distinct;

  const auto vertex = [&](Offset i) { return mesh.elements[i / (D + 1)][i % (D + 1)]; };
  first_at_vertex = beginnings(mesh.vertices(), elements * (D + 1), vertex);
  std::vector<Offset> next(first_at_vertex.begin(), first_at_vertex.end() - 1);
  at_vertex.resize(static_cast<std::size_t>(elements) * (D + 1));
  for (Offset i = 0; i < elements * (D + 1); ++i) at_vertex[next[vertex(i)]++] = static_cast<Index>(i / (D + 1));

  const auto number = [&](Offset i) { return edge[i]; };
  first_at_edge = beginnings(edges, elements * edges_per_element, number);
  next.assign(first_at_edge.begin(), first_at_edge.end() - 1);
  at_edge.resize(edge.size());
  for (Offset i = 0; i < elements * edges_per_element; ++i) at_edge[next[edge[i]]++] = static_cast<Index>(i);
}

template <int D>
std::array<Index, D*(D - 1) / 2> edges_of_face(const Mesh<D>& mesh, const Incidence<D>& incidence, Index face) {
  constexpr auto of_face = simplex_edges<D - 1>();
  constexpr auto of_element = simplex_edges<D>();
  const auto v = face_vertices<D>(mesh, incidence.sides[face]);
  const Index e = incidence.sides[face].element[0];
  const Simplex<D>& corner = mesh.elements[e];
  std::array<Index, D*(D - 1) / 2> out{};
  for (std::size_t k = 0; k < of_face.size(); ++k)
    for (std::size_t m = 0; m < of_element.size(); ++m) {
      const std::array ends{corner[of_element[m][0]], corner[of_element[m][1]]};
      if (sorted(ends) == sorted(std::array{v[of_face[k][0]], v[of_face[k][1]]}))
        out[k] = incidence.edge[static_cast<std::size_t>(e) * of_element.size() + m];
    }
  return out;
}

template <int D>
std::vector<Index> boundary_faces(const Mesh<D>& mesh, const Incidence<D>& incidence) {
  std::vector<Index> out;
  out.reserve(mesh.boundary.size());
  for (const Face<D>& face : mesh.boundary) {
    const Simplex<D>& element = mesh.elements[face.element];
    int opposite = 0;
    while (std::ranges::find(face.vertices, element[opposite]) != face.vertices.end()) ++opposite;
    out.push_back(incidence.face[Offset{face.element} * (D + 1) + opposite]);
  }
  return out;
}

template struct Incidence<2>;
template struct Incidence<3>;
template std::array<Index, 1> edges_of_face(const Mesh<2>&, const Incidence<2>&, Index);
template std::array<Index, 3> edges_of_face(const Mesh<3>&, const Incidence<3>&, Index);
template std::vector<Index> boundary_faces(const Mesh<2>&, const Incidence<2>&);
template std::vector<Index> boundary_faces(const Mesh<3>&, const Incidence<3>&);

}  // namespace signorini
