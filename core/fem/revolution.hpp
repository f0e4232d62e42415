#pragma once
#include <numbers>

#include "core/fem/model.hpp"
#include "core/mesh/mesh.hpp"

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

/// The hoop strain of an element is the mean of its radial displacements times this: the strain at the centroid. It is
/// exact for u_r = c r, and takes no limit at the axis, where u_r is zero. 0 where the body is not axisymmetric.
template <int D, std::size_t N>
inline double hoop_factor(Plane plane, const Mesh<D>& mesh, const std::array<Index, N>& vertices) {
  if (plane != Plane::axisymmetric) return 0;
  double sum = 0;
  for (const Index v : vertices) sum += mesh.points[v][0];
  return N / sum;
}

}  // namespace signorini
