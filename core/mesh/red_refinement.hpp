#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "core/mesh/simplex.hpp"

namespace signorini {

/// Children of a D-simplex by its corners 0..D and its edge midpoints D+1.., the latter in the order of simplex_edges;
/// all oriented as the father.
template <int D>
struct RedRefinement;

template <>
struct RedRefinement<1> {
  static constexpr std::array<std::array<int, 2>, 2> children{{{0, 2}, {2, 1}}};
};

template <>
struct RedRefinement<2> {
  static constexpr std::array<std::array<int, 3>, 4> children{{{0, 3, 4}, {3, 1, 5}, {4, 5, 2}, {3, 5, 4}}};
};

/// Bey's refinement, the inner diagonal between the midpoints 5 of edge 02 and 8 of edge 13; where Bey's order of the
/// vertices is negatively oriented, vertices 1 and 3 have changed places, which does not matter to further refinement.
template <>
struct RedRefinement<3> {
  static constexpr std::array<std::array<int, 4>, 8> children{
      {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3}, {4, 5, 6, 8}, {4, 8, 7, 5}, {5, 6, 8, 9}, {5, 9, 8, 7}}};
};

/// Number of an edge of a child among those found so far; their number where it is a new one.
template <std::size_t N>
constexpr std::size_t find_edge(const std::array<std::array<int, 2>, N>& edges, std::size_t found, int a, int b) {
  const std::array<int, 2> wanted{std::min(a, b), std::max(a, b)};
  std::size_t k = 0;
  while (k < found && edges[k] != wanted) ++k;
  return k;
}

/// The edges of all children, each once: its nodes, counted as in RedRefinement, in ascending order. 9 or 25.
template <int D>
constexpr auto child_edges() {
  constexpr auto all = [] {
    struct {
      std::array<std::array<int, 2>, RedRefinement<D>::children.size() * simplex_edges<D>().size()> ends{};
      std::size_t found = 0;
    } edges;
    for (const auto& child : RedRefinement<D>::children)
      for (const auto [a, b] : simplex_edges<D>()) {
        const std::size_t k = find_edge(edges.ends, edges.found, child[a], child[b]);
        edges.ends[k] = {std::min(child[a], child[b]), std::max(child[a], child[b])};
        edges.found = std::max(edges.found, k + 1);
      }
    return edges;
  }();
  std::array<std::array<int, 2>, all.found> edges;
  std::copy_n(all.ends.begin(), all.found, edges.begin());
  return edges;
}

/// Numbers among child_edges() of the edges of each child.
template <int D>
constexpr auto edges_of_children() {
  constexpr auto edges = child_edges<D>();
  std::array<std::array<std::size_t, simplex_edges<D>().size()>, RedRefinement<D>::children.size()> numbers{};
  for (std::size_t child = 0; child < numbers.size(); ++child)
    for (std::size_t k = 0; k < numbers[child].size(); ++k) {
      const auto [a, b] = simplex_edges<D>()[k];
      const auto& node = RedRefinement<D>::children[child];
      numbers[child][k] = find_edge(edges, edges.size(), node[a], node[b]);
    }
  return numbers;
}

}  // namespace signorini
