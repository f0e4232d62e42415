#pragma once
#include <algorithm>
#include <array>
#include <cassert>
#include <utility>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// The Lagrange nodes of a mesh: where a finite element function has its values. Vectors of unknowns are numbered as
/// the nodes; vertices, elements and faces as in the mesh. Linear elements have a node per vertex.
///
///     for (const Index p : nodes.of_element(e)) ...  // vectors of the element's unknowns
///     x = nodes.at(p);                               // where the p-th one is
///
/// Which basis function belongs to which of an element's nodes: see basis() in core/fem/element.hpp.
template <int D>
class Nodes {
 public:
  /// Numbered as the vertices, which takes no memory. Keeps a reference to the mesh.
  explicit Nodes(const Mesh<D>& mesh) : mesh_(&mesh), size_(mesh.vertices()) {}

  /// Numbered otherwise. Vertices with one node have the same values, as if the mesh were glued together there.
  /// @param of_vertex the node of each vertex; from 0 to the largest all numbers occur
  Nodes(const Mesh<D>& mesh, std::vector<Index> of_vertex) : mesh_(&mesh), of_vertex_(std::move(of_vertex)) {
    assert(of_vertex_.size() == mesh.points.size());
    size_ = of_vertex_.empty() ? 0 : *std::max_element(of_vertex_.begin(), of_vertex_.end()) + 1;
    vertex_.assign(static_cast<std::size_t>(size_), -1);
    for (auto v = static_cast<Index>(of_vertex_.size()) - 1; v >= 0; --v) vertex_[of_vertex_[v]] = v;
  }

  const Mesh<D>& mesh() const { return *mesh_; }
  Index size() const { return size_; }

  Index of_vertex(Index v) const { return of_vertex_.empty() ? v : of_vertex_[v]; }
  /// The vertex that a node is at, the first one of several; -1: none.
  Index vertex(Index p) const { return vertex_.empty() ? p : vertex_[p]; }
  const Point<D>& at(Index p) const { return mesh_->points[vertex(p)]; }

  /// Of a few vertices, in their order.
  template <std::size_t N>
  std::array<Index, N> of(const std::array<Index, N>& vertices) const {
    if (of_vertex_.empty()) return vertices;
    std::array<Index, N> out;
    for (std::size_t k = 0; k < N; ++k) out[k] = of_vertex_[vertices[k]];
    return out;
  }
  auto of_element(std::size_t e) const { return of(mesh_->elements[e]); }
  auto of_face(std::size_t f) const { return of(mesh_->boundary[f].vertices); }

  /// The same numbers on a mesh that differs by its points only.
  Nodes on(const Mesh<D>& moved) const {
    Nodes out = *this;
    out.mesh_ = &moved;
    return out;
  }

  /// Values at the vertices of a function given at the nodes, `count` numbers each, and back.
  std::vector<double> at_vertices(std::vector<double> values, int count) const {
    return of_vertex_.empty() ? values : picked(values, of_vertex_, count);
  }
  std::vector<double> at_nodes(std::vector<double> values, int count) const {
    return vertex_.empty() ? values : picked(values, vertex_, count);
  }

 private:
  static std::vector<double> picked(const std::vector<double>& values, const std::vector<Index>& from, int count) {
    std::vector<double> out;
    out.reserve(from.size() * static_cast<std::size_t>(count));
    for (const Index k : from)
      out.insert(out.end(), values.begin() + Offset{k} * count, values.begin() + Offset{k + 1} * count);
    return out;
  }

  const Mesh<D>* mesh_;
  Index size_;
  std::vector<Index> of_vertex_, vertex_;  // empty: as the vertices
};

/// Of all meshes of a hierarchy, coarsest first, numbered as the vertices.
template <int D>
std::vector<Nodes<D>> nodes_of(const MeshHierarchy<D>& hierarchy) {
  return {hierarchy.levels.begin(), hierarchy.levels.end()};
}

}  // namespace signorini
