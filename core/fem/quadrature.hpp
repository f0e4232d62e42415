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

}  // namespace signorini
