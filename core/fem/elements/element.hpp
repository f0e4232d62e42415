#pragma once
#include <cmath>
#include <numbers>

#include "core/algebra/local_basis.hpp"
#include "core/base/dot.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/input/field.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {

/// Cosine of the angle up to which faces that meet belong to one smooth surface: 30 degrees.
inline constexpr double smooth_cosine = std::numbers::sqrt3 / 2;

/// Measure (area or volume, negative for an inverted element) of a linear element and the constant gradients of its
/// hat functions.
template <int D>
struct LinearElement {
  double measure;
  std::array<Point<D>, D + 1> gradient;
};

inline LinearElement<2> linear_element(const std::array<Point<2>, 3>& corner) {
  const Point<2> a = difference<2>(corner[1], corner[0]);
  const Point<2> b = difference<2>(corner[2], corner[0]);
  const double det = a[0] * b[1] - a[1] * b[0], s = 1 / det;
  return {det / 2, {{{(a[1] - b[1]) * s, (b[0] - a[0]) * s}, {b[1] * s, -b[0] * s}, {-a[1] * s, a[0] * s}}}};
}

inline LinearElement<3> linear_element(const std::array<Point<3>, 4>& corner) {
  const Point<3> a = difference<3>(corner[1], corner[0]);
  const Point<3> b = difference<3>(corner[2], corner[0]);
  const Point<3> c = difference<3>(corner[3], corner[0]);
  const Point<3> bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double det = dot(a, bc), s = 1 / det;
  LinearElement<3> out{det / 6, {}};
  for (int i = 0; i < 3; ++i) {
    out.gradient[1][i] = bc[i] * s;
    out.gradient[2][i] = ca[i] * s;
    out.gradient[3][i] = ab[i] * s;
    out.gradient[0][i] = -(out.gradient[1][i] + out.gradient[2][i] + out.gradient[3][i]);
  }
  return out;
}

template <int D, std::size_t N>
inline std::array<Point<D>, N> points_of(const Mesh<D>& mesh, const std::array<Index, N>& vertices) {
  return points_of(mesh.points, vertices);
}

template <int D>
inline LinearElement<D> linear_element(const Mesh<D>& mesh, const Simplex<D>& v) {
  return linear_element(points_of(mesh, v));
}

template <int D>
inline Point<D> area_normal(const Mesh<D>& mesh, const Face<D>& face) {
  return area_normal(points_of(mesh, face.vertices));
}

/// The point with the given barycentric coordinates in a simplex of any dimension.
template <int D, std::size_t N>
inline Point<D> combine(const Mesh<D>& mesh, const std::array<Index, N>& vertices,
                        const std::array<double, N>& barycentric) {
  Point<D> x{};
  for (std::size_t a = 0; a < N; ++a)
    for (int i = 0; i < D; ++i) x[i] += barycentric[a] * mesh.points[vertices[a]][i];
  return x;
}

template <int D, std::size_t N>
inline Point<D> centroid(const Mesh<D>& mesh, const std::array<Index, N>& vertices) {
  std::array<double, N> barycentric;
  barycentric.fill(1.0 / N);
  return combine<D>(mesh, vertices, barycentric);
}

template <int D>
inline Site site(const Point<D>& x, double t, const Point<D>& normal = {}) {
  Site s;
  for (int i = 0; i < D; ++i) {
    s.x[i] = x[i];
    s.n[i] = normal[i];
  }
  s.t = t;
  return s;
}

/// For the material of element e, at x in it.
template <int D>
inline Site site_in(const Nodes<D>& nodes, std::size_t e, const Point<D>& x, double t) {
  Site s = site<D>(x, t);
  s.region = nodes.region(e);
  return s;
}
/// For the material of a simplex of the mesh: at its centroid, or at x in it.
template <int D>
inline Site site_in(const Mesh<D>& mesh, std::size_t e, const Point<D>& x, double t) {
  Site s = site<D>(x, t);
  if (!mesh.region.empty()) s.region = mesh.region[e];
  return s;
}
template <int D>
inline Site site_in(const Mesh<D>& mesh, std::size_t e, double t) {
  return site_in<D>(mesh, e, centroid<D>(mesh, mesh.elements[e]), t);
}

}  // namespace signorini
