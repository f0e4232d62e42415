#pragma once
#include <cmath>

#include "core/fem/elements/element.hpp"
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

/// All pairs of N nodes, in the order of simplex_edges.
template <std::size_t N>
constexpr auto node_pairs() {
  return simplex_edges<static_cast<int>(N) - 1>();
}

/// Adds what the basis functions with these gradients contribute at a point.
/// @param weight of the point: its part of the measure times the coefficient
template <std::size_t D, std::size_t N, std::size_t E>
inline void add_stiffness(const std::array<std::array<double, D>, N>& gradient, double weight,
                          LocalStiffness<N, E>& out) {
  constexpr auto ends = node_pairs<N>();
  for (std::size_t a = 0; a < N; ++a) out.diagonal[a] += weight * dot(gradient[a], gradient[a]);
  for (std::size_t k = 0; k < E; ++k) out.edge[k] += weight * dot(gradient[ends[k][0]], gradient[ends[k][1]]);
}

/// Entries that vanish but for rounding become zero: right angles uncouple many nodes.
template <std::size_t N, std::size_t E>
inline void clear_vanishing(LocalStiffness<N, E>& local, const std::array<std::array<int, 2>, E>& ends) {
  std::array<double, N> root;
  for (std::size_t a = 0; a < N; ++a) root[a] = std::sqrt(local.diagonal[a]);
  for (std::size_t k = 0; k < E; ++k)
    if (std::abs(local.edge[k]) <= vanishing * root[ends[k][0]] * root[ends[k][1]]) local.edge[k] = 0;
}

/// @param weight measure of the element times its coefficient
template <int D>
inline ElementStiffness<D> element_stiffness(const LinearElement<D>& element, double weight) {
  ElementStiffness<D> out{};
  add_stiffness(element.gradient, weight, out);
  clear_vanishing(out, simplex_edges<D>());
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
