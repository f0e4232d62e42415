#pragma once
#include <array>
#include <span>

namespace signorini {

/// A point of a quadrature rule on a simplex of dimension K; the weights of a rule sum to one.
template <int K>
struct QuadraturePoint {
  std::array<double, K + 1> barycentric;
  double weight;
};

/// Rules on segments (K = 1), triangles and tetrahedra, exact for polynomials of degree 2 and 5; all points lie inside
/// and all weights are positive. Degree 5: Gauss-Legendre; Radon (1948), 7 points; Walkington (2000), 14 points.
template <int K>
std::span<const QuadraturePoint<K>> quadrature2();
template <int K>
std::span<const QuadraturePoint<K>> quadrature5();

/// The rule of degree 1: the centroid.
template <int K>
std::span<const QuadraturePoint<K>> midpoint_rule() {
  static const QuadraturePoint<K> rule = [] {
    QuadraturePoint<K> q{{}, 1};
    q.barycentric.fill(1.0 / (K + 1));
    return q;
  }();
  return {&rule, 1};
}

/// For the stiffness of an element of order P: exact where its coefficients are constant and its edges straight
/// (`simple`). Else, of linear elements, coefficients are taken at the centroid.
template <int K, int P>
std::span<const QuadraturePoint<K>> stiffness_rule(bool simple) {
  if constexpr (P == 1) return midpoint_rule<K>();
  return simple ? quadrature2<K>() : quadrature5<K>();
}
/// The points of such a rule are no more than that.
template <int K, int P>
inline constexpr std::size_t most_stiffness_points = P == 1   ? 1
                                                     : K == 2 ? 7
                                                              : 14;

}  // namespace signorini
