#pragma once
#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// Numbers of edges or faces that are given several times, once by each element they belong to.
struct Numbering {
  std::vector<Index> number;  ///< per tuple; equal tuples have equal numbers
  Index distinct = 0;
};

/// Numbers the distinct ones among `count` K-tuples of vertices; `tuple(i)` returns the i-th one in ascending order.
/// Tuples are gathered by their smallest vertex and sorted there: linear time, flat arrays, and numbers that are as
/// local as those of the vertices.
template <int K, class Tuple>
Numbering number_subsimplices(Index vertices, Offset count, const Tuple& tuple) {
  static_assert(K >= 2);
  assert(count <= Offset{UINT32_MAX});
  struct Entry {
    std::array<Index, K - 1> rest;
    std::uint32_t position;
  };
  std::vector<Offset> start(static_cast<std::size_t>(vertices) + 1, 0);
  for (Offset i = 0; i < count; ++i) ++start[tuple(i)[0]];
  Offset sum = 0;
  for (Offset& s : start) sum += std::exchange(s, sum);

  std::vector<Entry> entries(count);
  for (Offset i = 0; i < count; ++i) {
    const std::array<Index, K> t = tuple(i);
    Entry& entry = entries[start[t[0]]++];
    std::copy(t.begin() + 1, t.end(), entry.rest.begin());
    entry.position = static_cast<std::uint32_t>(i);
  }

  Numbering result;
  result.number.resize(count);
  Offset first = 0;
  for (Index v = 0; v < vertices; ++v) {
    const Offset last = start[v];  // scattering has moved every start to the next one
    std::sort(entries.begin() + first, entries.begin() + last,
              [](const Entry& a, const Entry& b) { return a.rest < b.rest; });
    for (Offset i = first; i < last; ++i) {
      if (i == first || entries[i].rest != entries[i - 1].rest) ++result.distinct;
      result.number[entries[i].position] = result.distinct - 1;
    }
    first = last;
  }
  return result;
}

/// Numbers of the faces of all elements; that of the face opposite to vertex i of element e is at e * (D + 1) + i.
template <int D>
Numbering number_faces(Index vertices, const std::vector<std::array<Index, D + 1>>& elements);

/// Numbers of the edges of all elements, in the order of simplex_edges.
template <int D>
Numbering number_edges(Index vertices, const std::vector<std::array<Index, D + 1>>& elements);

}  // namespace signorini
