#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/types.hpp"

namespace signorini {

/// The vertices of a D-simplex by number.
template <int D>
using Simplex = std::array<Index, D + 1>;

/// The two ends of each edge of a D-simplex, in lexicographic order: D = 2: 01 02 12; D = 3: 01 02 03 12 13 23.
template <int D>
constexpr auto simplex_edges() {
  std::array<std::array<int, 2>, D*(D + 1) / 2> edges{};
  for (int a = 0, k = 0; a < D; ++a)
    for (int b = a + 1; b <= D; ++b) edges[k++] = {a, b};
  return edges;
}

/// The face opposite to one vertex of a positively oriented simplex, its normal pointing outwards.
template <int D>
std::array<Index, D> outward_face(const Simplex<D>& element, int opposite) {
  std::array<Index, D> face;
  for (int i = 0, k = 0; i <= D; ++i)
    if (i != opposite) face[k++] = element[i];
  if (opposite % 2 == 1) std::swap(face[D - 2], face[D - 1]);
  return face;
}

/// Reverses the orientation. The exchange of vertices 1 and D keeps the pair of edge midpoints that refinement joins.
template <int D>
void flip(Simplex<D>& element) {
  std::swap(element[1], element[D]);
}

template <std::size_t N>
std::array<Index, N> sorted(std::array<Index, N> tuple) {
  std::sort(tuple.begin(), tuple.end());
  return tuple;
}

template <int D>
Point<D> difference(const Point<D>& a, const Point<D>& b) {
  Point<D> d;
  for (int k = 0; k < D; ++k) d[k] = a[k] - b[k];
  return d;
}

template <int D>
Point<D> midpoint(const Point<D>& a, const Point<D>& b) {
  Point<D> m;
  for (int k = 0; k < D; ++k) m[k] = 0.5 * a[k] + 0.5 * b[k];
  return m;
}

template <int D>
double length(const Point<D>& a) {
  if constexpr (D == 2)
    return std::hypot(a[0], a[1]);
  else
    return std::hypot(a[0], a[1], a[2]);
}

/// Determinant of the matrix whose rows are given.
template <int D>
double determinant(const std::array<Point<D>, D>& m) {
  if constexpr (D == 2)
    return m[0][0] * m[1][1] - m[0][1] * m[1][0];
  else
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// The corners of a simplex; `points` is any container of Point<D>.
template <int D, class Points>
std::array<Point<D>, D + 1> corners(const Points& points, const Simplex<D>& element) {
  std::array<Point<D>, D + 1> p;
  for (int i = 0; i <= D; ++i) p[i] = points[element[i]];
  return p;
}

/// Area or volume, negative for negative orientation.
template <int D>
double signed_volume(const std::array<Point<D>, D + 1>& corner) {
  std::array<Point<D>, D> edge;
  for (int i = 0; i < D; ++i) edge[i] = difference<D>(corner[i + 1], corner[0]);
  return determinant<D>(edge) / (D == 2 ? 2 : 6);
}

template <int D>
double longest_edge(const std::array<Point<D>, D + 1>& corner) {
  double longest = 0;
  for (const auto [a, b] : simplex_edges<D>())
    longest = std::max(longest, length<D>(difference<D>(corner[b], corner[a])));
  return longest;
}

/// Signed volume over h^D, h the longest edge: a measure of shape that is free of units. 0 where h is 0.
template <int D>
double relative_volume(std::array<Point<D>, D + 1> corner) {
  const double h = longest_edge<D>(corner);
  if (!(h > 0)) return 0;
  const Point<D> origin = corner[0];
  for (auto& p : corner)  // scaled first: h^D may underflow
    for (int k = 0; k < D; ++k) p[k] = (p[k] - origin[k]) / h;
  return signed_volume<D>(corner);
}

}  // namespace signorini
