#pragma once
#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/mesh/element_map.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mesh/red_refinement.hpp"

namespace signorini {

/// The nodes of finite elements on a mesh. A function is given by a coefficient for each, which of linear elements is
/// its value there. Vectors of unknowns are numbered as the nodes; vertices, simplices and faces as in the mesh.
///
///     for (const Index p : nodes.of(nodes.elements<P>()[e])) ...  // vectors of the element's unknowns
///     x = nodes.at(p);                                            // where the p-th one is
///
/// Linear elements (order 1) are the simplices of the mesh, with a node per vertex. Quadratic ones (order 2) are its
/// families: the mesh is a uniform refinement, whose vertices are the nodes of quadratic elements on the coarser mesh,
/// and each element has been cut into the simplices of a family. Curved boundaries, where they have been refined, make
/// such elements curved (isoparametric).
/// Which basis function belongs to which of an element's nodes: see basis() in core/fem/elements/element.hpp.
template <int D>
class Nodes {
 public:
  /// Numbered as the vertices, which takes no memory. Keeps a reference to the mesh.
  explicit Nodes(const Mesh<D>& mesh, int order = 1) : mesh_(&mesh), order_(order), size_(mesh.vertices()) {
    find_ends();
  }

  /// Numbered otherwise. Vertices with one node have the same values, as if the mesh were glued together there.
  /// @param of_vertex the node of each vertex; from 0 to the largest all numbers occur
  Nodes(const Mesh<D>& mesh, std::vector<Index> of_vertex, int order = 1)
      : mesh_(&mesh), order_(order), of_vertex_(std::move(of_vertex)) {
    assert(of_vertex_.size() == mesh.points.size());
    size_ = of_vertex_.empty() ? 0 : *std::max_element(of_vertex_.begin(), of_vertex_.end()) + 1;
    vertex_.assign(static_cast<std::size_t>(size_), -1);
    for (auto v = static_cast<Index>(of_vertex_.size()) - 1; v >= 0; --v) vertex_[of_vertex_[v]] = v;
    find_ends();
  }

  const Mesh<D>& mesh() const { return *mesh_; }
  /// Of the elements: 1 or 2.
  int order() const { return order_; }
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
  /// Of a simplex of the mesh, or of one of its boundary faces.
  auto of_simplex(std::size_t e) const { return of(mesh_->elements[e]); }
  auto of_face(std::size_t f) const { return of(mesh_->boundary[f].vertices); }

  /// The elements by the vertices that are their nodes; P is the order.
  template <int P>
  const std::vector<std::array<Index, element_nodes<D, P>>>& elements() const {
    assert(P == order_);
    if constexpr (P == 1)
      return mesh_->elements;
    else
      return mesh_->families;
  }
  /// The material of an element: see Mesh::region.
  Index region(std::size_t e) const {
    const std::vector<Index>& regions = order_ == 1 ? mesh_->region : mesh_->family_region;
    return regions.empty() ? -1 : regions[e];
  }

  /// Boundary faces of the mesh that make one face of an element; they are numbered together.
  Index faces_per_element() const { return order_ == 1 ? 1 : Index{1} << (D - 1); }
  /// Such a face by the vertices that are its nodes.
  /// @param f the first face of the mesh that it is made of
  template <int P>
  std::array<Index, element_nodes<D - 1, P>> element_face(Index f) const {
    assert(P == order_);
    if constexpr (P == 1) {
      return mesh_->boundary[f].vertices;
    } else {
      constexpr auto& children = RedRefinement<D - 1>::children;
      std::array<Index, element_nodes<D - 1, P>> out;
      for (std::size_t child = 0; child < children.size(); ++child)
        for (int k = 0; k < D; ++k)
          out[children[child][k]] = mesh_->boundary[f + static_cast<Index>(child)].vertices[k];
      return out;
    }
  }

  /// The same numbers on a mesh that differs by its points only.
  Nodes on(const Mesh<D>& moved) const {
    Nodes out = *this;
    out.mesh_ = &moved;
    return out;
  }

  /// The corners that a node is the midpoint between; twice itself for one that is a corner.
  std::array<Index, 2> ends(Index p) const { return ends_ ? (*ends_)[p] : std::array{p, p}; }

  /// The value at a midpoint with these coefficients there and at its ends, and back.
  static double midpoint_value(double coefficient, double a, double b) {
    return midpoint_weight * coefficient + (1 - midpoint_weight) * ((a + b) / 2);
  }
  static double midpoint_coefficient(double value, double a, double b) {
    return (value - (1 - midpoint_weight) * ((a + b) / 2)) / midpoint_weight;
  }

  /// The coefficient at a node of the function with these values at nodes: value(q).
  template <class Value>
  double coefficient(Index p, const Value& value) const {
    const auto [a, b] = ends(p);
    return a == b ? value(p) : midpoint_coefficient(value(p), value(a), value(b));
  }

  /// The point whose coordinates are the coefficients of the coordinates: that of a midpoint on a curved edge is not
  /// where the node is.
  Point<D> control_point(Index p) const {
    Point<D> out;
    for (int i = 0; i < D; ++i) out[i] = coefficient(p, [&](Index q) { return at(q)[i]; });
    return out;
  }

  /// Values at the vertices of a function given by its coefficients, `count` numbers each, and back.
  std::vector<double> at_vertices(std::vector<double> coefficients, int count) const {
    each_midpoint(count, [&](std::size_t m, std::size_t a, std::size_t b) {
      coefficients[m] = midpoint_value(coefficients[m], coefficients[a], coefficients[b]);
    });
    return per_vertex(std::move(coefficients), count);
  }
  std::vector<double> at_nodes(std::vector<double> values, int count) const {
    if (!vertex_.empty()) values = picked(values, vertex_, count);
    each_midpoint(count, [&](std::size_t m, std::size_t a, std::size_t b) {
      values[m] = midpoint_coefficient(values[m], values[a], values[b]);
    });
    return values;
  }

  /// What is known of the nodes, `count` numbers each, at the vertices.
  std::vector<double> per_vertex(std::vector<double> of_nodes, int count) const {
    if (of_vertex_.empty()) return of_nodes;
    return picked(of_nodes, of_vertex_, count);
  }

 private:
  void find_ends() {
    if (order_ == 1) return;
    assert(!mesh_->families.empty());
    constexpr auto edges = simplex_edges<D>();
    std::vector<std::array<Index, 2>> found(static_cast<std::size_t>(size_));
    for (const Family<D>& family : mesh_->families) {
      const auto node = of(family);
      for (int a = 0; a <= D; ++a) found[node[a]] = {node[a], node[a]};
      for (std::size_t k = 0; k < edges.size(); ++k) found[node[D + 1 + k]] = {node[edges[k][0]], node[edges[k][1]]};
    }
    ends_ = std::make_shared<const std::vector<std::array<Index, 2>>>(std::move(found));
  }

  /// Calls use(m, a, b) for each number of each midpoint, with those of its ends.
  template <class Use>
  void each_midpoint(int count, const Use& use) const {
    for (Index p = 0; p < (ends_ ? size_ : 0); ++p)
      if (const auto [a, b] = (*ends_)[p]; a != b)
        for (int i = 0; i < count; ++i)
          use(static_cast<std::size_t>(p) * count + i, static_cast<std::size_t>(a) * count + i,
              static_cast<std::size_t>(b) * count + i);
  }

  static std::vector<double> picked(const std::vector<double>& values, const std::vector<Index>& from, int count) {
    std::vector<double> out;
    out.reserve(from.size() * static_cast<std::size_t>(count));
    for (const Index k : from)
      out.insert(out.end(), values.begin() + Offset{k} * count, values.begin() + Offset{k + 1} * count);
    return out;
  }

  const Mesh<D>* mesh_;
  int order_ = 1;
  Index size_;
  std::vector<Index> of_vertex_, vertex_;                          // empty: as the vertices
  std::shared_ptr<const std::vector<std::array<Index, 2>>> ends_;  // per node of quadratic elements
};

/// Calls use(order) with the order of the elements as a constant: std::integral_constant<int, 1> or <int, 2>.
template <int D, class Use>
decltype(auto) with_order(const Nodes<D>& nodes, const Use& use) {
  if (nodes.order() == 1) return use(std::integral_constant<int, 1>());
  return use(std::integral_constant<int, 2>());
}

/// Of all meshes of a hierarchy, coarsest first, numbered as the vertices. Elements are linear but for the finest mesh,
/// where they have the order: quadratic ones there are those of the mesh before it.
template <int D>
std::vector<Nodes<D>> nodes_of(const MeshHierarchy<D>& hierarchy, int order = 1) {
  std::vector<Nodes<D>> out(hierarchy.levels.begin(), hierarchy.levels.end());
  out.back() = Nodes<D>(hierarchy.finest(), order);
  return out;
}

}  // namespace signorini
