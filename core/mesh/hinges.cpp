#include "core/mesh/hinges.hpp"

#include <algorithm>
#include <utility>

#include "core/mesh/simplex.hpp"
#include "core/mesh/subsimplices.hpp"

namespace signorini {
namespace {

/// Disjoint sets of 0 ... n - 1.
class Sets {
 public:
  explicit Sets(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) root_.push_back(static_cast<Index>(i));
  }
  Index find(Index i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }
  void join(Index i, Index j) { root_[find(i)] = find(j); }

 private:
  std::vector<Index> root_;
};

/// Elements around one vertex, joined where they share a face that holds it.
bool is_one_fan(const std::vector<Simplex<3>>& elements, Index vertex) {
  struct Side {
    std::array<Index, 2> others;
    Index element;
  };
  std::vector<Side> sides;
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (int opposite = 0; opposite <= 3; ++opposite) {
      if (elements[e][opposite] == vertex) continue;
      std::array<Index, 2> others{};
      for (int i = 0, k = 0; i <= 3; ++i)
        if (i != opposite && elements[e][i] != vertex) others[k++] = elements[e][i];
      sides.push_back({sorted(others), static_cast<Index>(e)});
    }
  std::ranges::sort(sides, {}, &Side::others);
  Sets sets(elements.size());
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i].others == sides[i - 1].others) sets.join(sides[i].element, sides[i - 1].element);
  for (std::size_t e = 1; e < elements.size(); ++e)
    if (sets.find(static_cast<Index>(e)) != sets.find(0)) return false;
  return true;
}

/// Boundary faces of a mesh of tetrahedra, seen from their edges.
class BoundaryEdges {
 public:
  explicit BoundaryEdges(const Mesh<3>& mesh) : mesh_(mesh) {
    edges_ = number_subsimplices<2>(mesh.vertices(), count(), [&](Offset i) { return edge(i); });
    shared_.assign(edges_.distinct, 0);
    for (const Index e : edges_.number) ++shared_[e];
  }

  /// Around a boundary edge every fan of elements ends with two faces.
  std::vector<std::array<Index, 2>> of_several_fans() const {
    std::vector<std::array<Index, 2>> found;
    std::vector<std::uint8_t> named(edges_.distinct, 0);
    for (Offset i = 0; i < count(); ++i)
      if (const Index e = edges_.number[i]; shared_[e] > 2 && !std::exchange(named[e], 1)) found.push_back(edge(i));
    std::ranges::sort(found);
    return found;
  }

  /// Vertices whose boundary faces are not all joined by edges at the vertex.
  std::vector<Index> vertices_of_several_sheets() const {
    Sets sets(3 * mesh_.boundary.size());  // of the corners of faces
    std::vector<Offset> first(edges_.distinct, -1);
    for (Offset i = 0; i < count(); ++i) {
      Offset& other = first[edges_.number[i]];
      if (other < 0) other = i;
      for (const Index v : edge(i)) sets.join(corner(i / 3, v), corner(other / 3, v));
    }
    std::vector<Index> sheet(mesh_.points.size(), -1), found;
    for (std::size_t f = 0; f < mesh_.boundary.size(); ++f)
      for (const Index v : mesh_.boundary[f].vertices) {
        const Index s = sets.find(corner(static_cast<Offset>(f), v));
        if (sheet[v] < 0) sheet[v] = s;
        if (sheet[v] != s) found.push_back(v);
      }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  Offset count() const { return 3 * static_cast<Offset>(mesh_.boundary.size()); }
  std::array<Index, 2> edge(Offset i) const {
    const auto& v = mesh_.boundary[i / 3].vertices;
    return sorted(std::array<Index, 2>{v[i % 3], v[(i + 1) % 3]});
  }
  Index corner(Offset face, Index vertex) const {
    const auto& v = mesh_.boundary[face].vertices;
    return static_cast<Index>(3 * face + (std::find(v.begin(), v.end(), vertex) - v.begin()));
  }

  const Mesh<3>& mesh_;
  Numbering edges_;
  std::vector<Index> shared_;
};

/// A tip of a cavity that meets another one has several sheets too: what counts are the elements.
void keep_several_fans(const Mesh<3>& mesh, std::vector<Index>& vertices) {
  if (vertices.empty()) return;
  std::vector<Index> slot(mesh.points.size(), -1);
  for (std::size_t k = 0; k < vertices.size(); ++k) slot[vertices[k]] = static_cast<Index>(k);
  std::vector<std::vector<Simplex<3>>> around(vertices.size());
  for (const Simplex<3>& element : mesh.elements)
    for (const Index v : element)
      if (slot[v] >= 0) around[slot[v]].push_back(element);
  std::erase_if(vertices, [&](Index v) { return is_one_fan(around[slot[v]], v); });
}

}  // namespace

/// Around a boundary vertex every fan of triangles ends with two edges.
Hinges find_hinges(const Mesh<2>& mesh) {
  std::vector<Index> ends(mesh.points.size(), 0);
  for (const Face<2>& face : mesh.boundary)
    for (const Index v : face.vertices) ++ends[v];
  Hinges hinges;
  for (Index v = 0; v < mesh.vertices(); ++v)
    if (ends[v] > 2) hinges.vertices.push_back(v);
  return hinges;
}

Hinges find_hinges(const Mesh<3>& mesh) {
  const BoundaryEdges edges(mesh);
  Hinges hinges{edges.vertices_of_several_sheets(), edges.of_several_fans()};
  std::vector<std::uint8_t> named(mesh.points.size(), 0);
  for (const auto& edge : hinges.edges)
    for (const Index v : edge) named[v] = 1;
  std::erase_if(hinges.vertices, [&](Index v) { return named[v] != 0; });
  keep_several_fans(mesh, hinges.vertices);
  return hinges;
}

}  // namespace signorini
