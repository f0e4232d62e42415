#pragma once
#include <array>

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

}  // namespace signorini
