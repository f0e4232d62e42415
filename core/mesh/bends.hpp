#pragma once
#include "core/mesh/mesh.hpp"
#include "core/mesh/red_refinement.hpp"

namespace signorini {

/// The number of the edge between two corners in simplex_edges.
template <int D>
constexpr std::size_t edge_between(int a, int b) {
  constexpr auto edges = simplex_edges<D>();
  std::size_t k = 0;
  while (edges[k] != std::array{std::min(a, b), std::max(a, b)}) ++k;
  return k;
}

/// Of an element whose corners have changed places: corner i is what corner `was[i]` has been.
template <int D>
Bends<D> permuted(const Bends<D>& bends, const std::array<int, D + 1>& was) {
  constexpr auto edges = simplex_edges<D>();
  Bends<D> out;
  for (std::size_t k = 0; k < edges.size(); ++k) out[k] = bends[edge_between<D>(was[edges[k][0]], was[edges[k][1]])];
  return out;
}

/// By how much the middle of an edge within an element is off the straight one. Along a step w in barycentric
/// coordinates, of sum zero, the second difference of the element's quadratic map is a quadratic form q(w), and the
/// midpoint is off by its value. Known on the edges of the element, it is
/// q(w) = -sum over its edges ij of w_i w_j q(e_j - e_i).
/// @param from, to the edge's ends in barycentric coordinates of the element
template <int D>
Point<D> bend_of(const Bends<D>& bends, const std::array<double, D + 1>& from, const std::array<double, D + 1>& to) {
  constexpr auto edges = simplex_edges<D>();
  Point<D> out{};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [i, j] = edges[e];
    const double weight = -(to[i] - from[i]) * (to[j] - from[j]);
    for (int d = 0; d < D; ++d) out[d] += weight * bends[e][d];
  }
  return out;
}

/// Of a child that red refinement makes: that of the same quadratic map.
template <int D>
Bends<D> bends_of_child(const Bends<D>& father, std::size_t child) {
  constexpr auto edges = simplex_edges<D>();
  const auto barycentric = [&](int node) {
    std::array<double, D + 1> out{};
    if (node <= D)
      out[node] = 1;
    else
      for (const int end : edges[node - D - 1]) out[end] = 0.5;
    return out;
  };
  Bends<D> out{};
  const auto& corner = RedRefinement<D>::children[child];
  for (std::size_t k = 0; k < edges.size(); ++k)
    out[k] = bend_of<D>(father, barycentric(corner[edges[k][0]]), barycentric(corner[edges[k][1]]));
  return out;
}

}  // namespace signorini
