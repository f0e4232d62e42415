#pragma once
#include <array>
#include <vector>

#include "core/base/dot.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mesh/simplex.hpp"

/// Basis functions of elements on simplices, and the maps that they make.
namespace signorini {

/// Nodes of an element of order P on a simplex of dimension K: its corners, for P = 2 then the midpoints of its
/// edges, in the order of simplex_edges.
template <int K, int P>
inline constexpr std::size_t element_nodes = P == 1 ? K + 1 : (K + 1) * (K + 2) / 2;

/// What the coefficient at the midpoint of a quadratic element's edge weighs in the value there; the ends have the rest
/// in equal parts. With 1 coefficients were values, but the basis functions of corners would have no mean on triangles
/// and a negative one on tetrahedra: a pressure would pull there. With 1/2 the basis were Bernstein's, positive
/// everywhere, but bounds of coefficients would keep elements off that only the edge of the contact touches. All means
/// are positive below 5/6.
inline constexpr double midpoint_weight = 0.8;

template <class Point, std::size_t N>
inline std::array<Point, N> points_of(const std::vector<Point>& all, const std::array<Index, N>& vertices) {
  std::array<Point, N> points;
  for (std::size_t a = 0; a < N; ++a) points[a] = all[vertices[a]];
  return points;
}

/// Outer normal of a boundary face, its length the measure (length or area) of the face.
inline Point<2> area_normal(const std::array<Point<2>, 2>& corner) {
  const Point<2> d = difference<2>(corner[1], corner[0]);
  return {d[1], -d[0]};
}

inline Point<3> area_normal(const std::array<Point<3>, 3>& corner) {
  Point<3> n = cross(difference<3>(corner[1], corner[0]), difference<3>(corner[2], corner[0]));
  for (double& c : n) c /= 2;
  return n;
}

/// Values of the basis functions of order P of a simplex's nodes, in their order, at a point given by barycentric
/// coordinates. The coefficient of a corner is the value there; for that of a midpoint see midpoint_weight.
template <int P, std::size_t N>
inline std::array<double, element_nodes<N - 1, P>> basis(const std::array<double, N>& barycentric) {
  if constexpr (P == 1) {
    return barycentric;
  } else {
    constexpr auto ends = simplex_edges<N - 1>();
    std::array<double, element_nodes<N - 1, P>> out;
    for (std::size_t a = 0; a < N; ++a) out[a] = barycentric[a] * (1 - 2 * midpoint_weight * (1 - barycentric[a]));
    for (std::size_t k = 0; k < ends.size(); ++k)
      out[N + k] = 4 * midpoint_weight * barycentric[ends[k][0]] * barycentric[ends[k][1]];
    return out;
  }
}

/// Barycentric coordinates of a simplex's k-th node, of order 1 or 2.
template <int D>
inline std::array<double, D + 1> node_place(std::size_t k) {
  constexpr auto ends = simplex_edges<D>();
  std::array<double, D + 1> out{};
  if (k <= D) out[k] = 1;
  if (k > D) out[ends[k - D - 1][0]] = out[ends[k - D - 1][1]] = 0.5;
  return out;
}

template <int K>
inline std::array<double, K + 1> barycentre() {
  std::array<double, K + 1> out;
  out.fill(1.0 / (K + 1));
  return out;
}

/// The mean of the k-th one over a simplex of dimension K.
template <int P, int K>
constexpr double basis_mean(std::size_t k) {
  if constexpr (P == 1) return 1.0 / (K + 1);
  constexpr double of_midpoint = 4 * midpoint_weight / ((K + 1) * (K + 2));
  return k > K ? of_midpoint : 1.0 / (K + 1) - of_midpoint * K / 2;
}

/// The gradients of these functions, given those of the barycentric coordinates.
template <int P, std::size_t D, std::size_t N>
inline std::array<std::array<double, D>, element_nodes<N - 1, P>> basis_gradients(
    const std::array<std::array<double, D>, N>& gradient, const std::array<double, N>& barycentric) {
  if constexpr (P == 1) {
    return gradient;
  } else {
    constexpr auto ends = simplex_edges<N - 1>();
    std::array<std::array<double, D>, element_nodes<N - 1, P>> out;
    for (std::size_t a = 0; a < N; ++a)
      for (std::size_t i = 0; i < D; ++i)
        out[a][i] = (1 - 2 * midpoint_weight + 4 * midpoint_weight * barycentric[a]) * gradient[a][i];
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const auto [a, b] = ends[k];
      for (std::size_t i = 0; i < D; ++i)
        out[N + k][i] = 4 * midpoint_weight * (barycentric[a] * gradient[b][i] + barycentric[b] * gradient[a][i]);
    }
    return out;
  }
}

/// A simplex of dimension K in space D through its nodes of order P: curved, unless the midpoints of its edges are
/// midpoints.
template <int D, int K, int P>
class ElementMap {
 public:
  static constexpr std::size_t nodes = element_nodes<K, P>;

  ElementMap(const Mesh<D>& mesh, const std::array<Index, nodes>& vertices) : ElementMap(mesh.points, vertices) {}
  ElementMap(const std::vector<Point<D>>& points, const std::array<Index, nodes>& vertices)
      : ElementMap(points_of(points, vertices)) {}
  explicit ElementMap(const std::array<Point<D>, nodes>& at) : control_(at) {
    if constexpr (P > 1) {
      constexpr auto ends = simplex_edges<K>();
      for (std::size_t k = 0; k < ends.size(); ++k) {
        const Point<D> middle = midpoint<D>(control_[ends[k][0]], control_[ends[k][1]]);
        Point<D>& point = control_[K + 1 + k];
        if (point == middle) continue;
        curved_ = true;
        for (int i = 0; i < D; ++i) point[i] = middle[i] + (point[i] - middle[i]) / midpoint_weight;
      }
    }
  }

  bool curved() const { return curved_; }

  Point<D> operator()(const std::array<double, K + 1>& barycentric) const {
    const auto value = basis<P>(barycentric);
    Point<D> x{};
    for (std::size_t a = 0; a < nodes; ++a)
      for (int i = 0; i < D; ++i) x[i] += value[a] * control_[a][i];
    return x;
  }

  /// The corners, up to a translation, of the flat simplex that it is like at a point: the derivatives there along the
  /// barycentric coordinates.
  std::array<Point<D>, K + 1> flat(const std::array<double, K + 1>& barycentric) const {
    std::array<Point<D>, K + 1> corner;
    std::copy_n(control_.begin(), K + 1, corner.begin());
    if (!curved_) return corner;
    constexpr auto ends = simplex_edges<K>();
    for (int a = 0; a <= K; ++a)
      for (int i = 0; i < D; ++i) corner[a][i] *= 1 - 2 * midpoint_weight + 4 * midpoint_weight * barycentric[a];
    for (std::size_t k = 0; K + 1 + k < nodes; ++k) {
      const auto [a, b] = ends[k];
      for (int i = 0; i < D; ++i) {
        corner[a][i] += 4 * midpoint_weight * barycentric[b] * control_[K + 1 + k][i];
        corner[b][i] += 4 * midpoint_weight * barycentric[a] * control_[K + 1 + k][i];
      }
    }
    return corner;
  }

 private:
  std::array<Point<D>, nodes> control_;  // what the basis functions are multiplied with
  bool curved_ = false;
};

}  // namespace signorini
