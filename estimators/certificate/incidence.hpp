#pragma once
#include <array>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {

/// Which elements, faces and edges of a mesh meet: flat arrays, linear in the mesh.
template <int D>
struct Incidence {
  static constexpr int edges_per_element = D * (D + 1) / 2;

  explicit Incidence(const Mesh<D>& mesh);

  /// The elements beside a face, and which of their faces it is: that opposite to this vertex of theirs. The normal of
  /// a face points out of the first one; the second is -1 where the mesh ends.
  struct Sides {
    std::array<Index, 2> element{-1, -1};
    std::array<std::int8_t, 2> opposite{0, 0};
    bool outer() const { return element[1] < 0; }
  };

  std::vector<Index> face;   ///< D + 1 per element: the one opposite to each vertex
  std::vector<Sides> sides;  ///< per face
  std::vector<Index> edge;   ///< per element, in the order of simplex_edges
  Index edges = 0;

  std::vector<Offset> first_at_vertex, first_at_edge;  ///< where the lists below begin
  std::vector<Index> at_vertex;                        ///< elements around each vertex
  std::vector<Index> at_edge;  ///< around each edge: element * edges_per_element + its number there

  Index faces() const { return static_cast<Index>(sides.size()); }
};

/// The places of an element's vertices in the ascending order of their numbers. Faces list their vertices in that
/// order.
template <int D>
std::array<std::int8_t, D + 1> ranks(const Simplex<D>& element) {
  std::array<std::int8_t, D + 1> rank{};
  for (int a = 0; a <= D; ++a)
    for (int b = 0; b <= D; ++b) rank[a] = static_cast<std::int8_t>(rank[a] + (element[b] < element[a]));
  return rank;
}

/// The place of vertex `a` of an element among those of its face opposite to another one.
template <std::size_t N>
int place_on_face(const std::array<std::int8_t, N>& rank, int opposite, int a) {
  return rank[a] - (rank[a] > rank[opposite]);
}

/// The vertices of a face, ascending.
template <int D>
std::array<Index, D> face_vertices(const Mesh<D>& mesh, const typename Incidence<D>::Sides& sides) {
  std::array<Index, D> out;
  for (int a = 0, k = 0; a <= D; ++a)
    if (a != sides.opposite[0]) out[k++] = mesh.elements[sides.element[0]][a];
  return sorted(out);
}

/// The edges of a face, in the order of simplex_edges of its vertices.
template <int D>
std::array<Index, D*(D - 1) / 2> edges_of_face(const Mesh<D>& mesh, const Incidence<D>& incidence, Index face);

/// The face of the mesh that each of its boundary faces is.
template <int D>
std::vector<Index> boundary_faces(const Mesh<D>& mesh, const Incidence<D>& incidence);

}  // namespace signorini
