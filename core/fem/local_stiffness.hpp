#pragma once
#include <cmath>

#include "core/fem/element.hpp"
#include "core/mesh/red_refinement.hpp"

namespace signorini {

/// Stiffness of diffusion on a few elements: an entry per vertex and one per edge.
template <std::size_t Vertices, std::size_t Edges>
struct LocalStiffness {
  std::array<double, Vertices> diagonal;
  std::array<double, Edges> edge;
};

/// On an element, the edges as in simplex_edges.
template <int D>
using ElementStiffness = LocalStiffness<D + 1, simplex_edges<D>().size()>;

/// On the children of an element together, the edges as in child_edges.
template <int D>
using FamilyStiffness = LocalStiffness<std::tuple_size_v<Family<D>>, child_edges<D>().size()>;

/// Entries below this multiple of the geometric mean of their diagonal entries vanish but for rounding.
inline constexpr double vanishing = 1e-15;

/// @param weight measure of the element times its coefficient
/// Entries that vanish but for rounding are zero: right angles uncouple many vertices.
template <int D>
inline ElementStiffness<D> element_stiffness(const LinearElement<D>& element, double weight) {
  constexpr auto ends = simplex_edges<D>();
  ElementStiffness<D> out;
  std::array<double, D + 1> root;
  for (int a = 0; a <= D; ++a) {
    out.diagonal[a] = weight * dot(element.gradient[a], element.gradient[a]);
    root[a] = std::sqrt(out.diagonal[a]);
  }
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const auto [a, b] = ends[k];
    const double value = weight * dot(element.gradient[a], element.gradient[b]);
    out.edge[k] = std::abs(value) <= vanishing * root[a] * root[b] ? 0 : value;
  }
  return out;
}

/// Stiffness of the children of an element with straight edges and one coefficient: it follows from the element's own,
/// without any geometry.
template <int D>
class RedStiffness {
 public:
  // x' K y is minus the sum over the edges ab of K_ab (x_a - x_b)(y_a - y_b), so what a child's hat functions
  // contribute depends on how they grow along the edges of the father; that is the same for all fathers.
  RedStiffness() {
    const Mesh<D> mesh = reference();
    for (std::size_t child = 0; child < children.size(); ++child) {
      const LinearElement<D> s = linear_element(mesh, children[child]);
      for (std::size_t k = 0; k < ends.size(); ++k) {
        const Point<D> along = difference<D>(mesh.points[ends[k][1]], mesh.points[ends[k][0]]);
        std::array<double, D + 1> growth;
        for (int a = 0; a <= D; ++a) growth[a] = dot(s.gradient[a], along);
        add(child, growth, of_edge_[k]);
      }
    }
  }

  FamilyStiffness<D> children_of(const ElementStiffness<D>& father) const {
    FamilyStiffness<D> out;
    for (std::size_t i = 0; i < out.diagonal.size(); ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < ends.size(); ++k) sum += father.edge[k] * of_edge_[k].diagonal[i];
      out.diagonal[i] = sum;
    }
    for (std::size_t i = 0; i < out.edge.size(); ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < ends.size(); ++k) sum += father.edge[k] * of_edge_[k].edge[i];
      out.edge[i] = sum;
    }
    return out;
  }

 private:
  static constexpr auto ends = simplex_edges<D>();
  static constexpr auto& children = RedRefinement<D>::children;

  static Mesh<D> reference() {
    Mesh<D> mesh;
    mesh.points.resize(D + 1);
    for (int i = 0; i < D; ++i) mesh.points[i + 1][i] = 1;
    for (const auto [a, b] : ends) mesh.points.push_back(midpoint<D>(mesh.points[a], mesh.points[b]));
    return mesh;
  }

  static void add(std::size_t child, const std::array<double, D + 1>& growth, FamilyStiffness<D>& out) {
    constexpr auto edges = edges_of_children<D>();
    constexpr double share = 1.0 / children.size();  // of the father's measure
    for (int a = 0; a <= D; ++a) out.diagonal[children[child][a]] -= share * growth[a] * growth[a];
    for (std::size_t k = 0; k < ends.size(); ++k)
      out.edge[edges[child][k]] -= share * growth[ends[k][0]] * growth[ends[k][1]];
  }

  std::array<FamilyStiffness<D>, ends.size()> of_edge_{};  // of the children, per unit of an edge's entry of the father
};

}  // namespace signorini
