#pragma once
#include <numbers>

#include "core/fem/elements/element.hpp"
#include "core/fem/model/model.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mesh/quadrature.hpp"

namespace signorini {

/// Axisymmetric bodies: a point (r, z) of the mesh stands for its circle around the axis, a face for a surface and an
/// element for a ring. All measures are those of the whole body, all forces too.

/// 2 pi r, the length of the circle of a point; 1 where the body is not axisymmetric.
template <int D>
inline double circumference(Plane plane, const Point<D>& x) {
  return plane == Plane::axisymmetric ? 2 * std::numbers::pi * x[0] : 1.0;
}

/// Its mean over a simplex: times the simplex's measure that of what it stands for.
template <int D, std::size_t N>
inline double mean_circumference(Plane plane, const Mesh<D>& mesh, const std::array<Index, N>& vertices) {
  if (plane != Plane::axisymmetric) return 1;
  double sum = 0;
  for (const Index v : vertices) sum += circumference<D>(plane, mesh.points[v]);
  return sum / N;
}

/// The mean of its product with the k-th hat function.
template <int D, std::size_t N>
inline double hat_circumference(Plane plane, const Mesh<D>& mesh, const std::array<Index, N>& vertices, std::size_t k) {
  double sum = circumference<D>(plane, mesh.points[vertices[k]]);  // products of hat functions have integrals 1 : 2
  for (const Index v : vertices) sum += circumference<D>(plane, mesh.points[v]);
  return sum / (N * (N + 1));
}

/// The mean of the k-th basis function of order P over a simplex, weighted by the circumference as it is between its
/// corners: a part of what it stands for. Positive, and all sum to one.
template <int P, int D, int K>
inline double circumference_share(const Mesh<D>& mesh, const std::array<Index, element_nodes<K, P>>& vertices,
                                  std::size_t k) {
  double part = 0, whole = 0;
  for (const auto& [barycentric, weight] : quadrature5<K>()) {
    double r = 0;
    for (std::size_t a = 0; a <= K; ++a) r += barycentric[a] * mesh.points[vertices[a]][0];
    part += weight * r * basis<P>(barycentric)[k];
    whole += weight * r;
  }
  return whole > 0 ? part / whole : 0;
}

/// Measure of what a simplex, curved for P = 2, stands for.
template <int P, int D, int K>
inline double ring_measure(const Mesh<D>& mesh, const std::array<Index, element_nodes<K, P>>& vertices) {
  const ElementMap<D, K, P> map(mesh, vertices);
  double sum = 0;
  for (const auto& [barycentric, weight] : quadrature5<K>()) {
    const auto flat = map.flat(barycentric);
    double measure;
    if constexpr (K == D)
      measure = linear_element(flat).measure;
    else
      measure = length<D>(area_normal(flat));
    sum += weight * measure * circumference<D>(Plane::axisymmetric, map(barycentric));
  }
  return sum;
}

/// The hoop strain of a quadratic element at a point at radius r, per radial displacement, is that of a basis function
/// over r. Points of rules lie inside elements, off the axis. Zeros where the body is not axisymmetric.
template <int P, int D, std::size_t N>
inline std::array<double, element_nodes<N - 1, P>> hoop_values(Plane plane, const Point<D>& x,
                                                               const std::array<double, N>& barycentric) {
  std::array<double, element_nodes<N - 1, P>> out{};
  if (plane != Plane::axisymmetric) return out;
  out = basis<P>(barycentric);
  for (double& value : out) value /= x[0];
  return out;
}

/// The hoop strain of a linear element is the mean of its radial displacements times this: the strain at the centroid.
/// It is exact for u_r = c r, and takes no limit at the axis, where u_r is zero. 0 where the body is not axisymmetric.
template <int D, std::size_t N>
inline double hoop_factor(Plane plane, const Mesh<D>& mesh, const std::array<Index, N>& vertices) {
  if (plane != Plane::axisymmetric) return 0;
  double sum = 0;
  for (const Index v : vertices) sum += mesh.points[v][0];
  return N / sum;
}

}  // namespace signorini
