#include <cmath>

#include "estimators/certificate/free_changes.hpp"
#include "estimators/certificate/small_solve.hpp"

namespace signorini {
namespace {

/// Linear tractions along a face without force and moment: w_k = S M^+ (x_k - c), S symmetric in its plane and
/// M = sum of (x_k - c)(x_k - c)'. They have mass sum of |w_k|^2 / (D (D + 1)).
template <int D>
struct Tangential {
  static constexpr int count = D * (D - 1) / 2;
  std::array<std::array<Point<D>, D>, count> w;  // at the vertices

  explicit Tangential(const std::array<Point<2>, 2>& x) requires(D == 2) {
    Point<2> along = difference<2>(x[1], x[0]);
    normalise(along);
    w[0][0] = {-along[0], -along[1]};
    w[0][1] = along;
  }

  explicit Tangential(const std::array<Point<3>, 3>& x) requires(D == 3) {
    Point<3> c{};
    for (const Point<3>& p : x)
      for (int i = 0; i < 3; ++i) c[i] += p[i] / 3;
    Point<3> e1 = difference<3>(x[1], x[0]), normal = area_normal(x);
    normalise(e1);
    normalise(normal);
    const Point<3> e2 = cross(normal, e1);
    std::array<Point<2>, 3> flat;
    std::array<double, 4> M{};
    for (int k = 0; k < 3; ++k) {
      const Point<3> from = difference<3>(x[k], c);
      flat[k] = {dot(from, e1), dot(from, e2)};
      for (int i = 0; i < 4; ++i) M[i] += flat[k][i / 2] * flat[k][i % 2];
    }
    const double size = std::sqrt(M[0] + M[3]);
    for (int k = 0; k < 3; ++k) {
      const Point<2> y = solved(M, flat[k]);
      for (int i = 0; i < 3; ++i) {
        w[0][k][i] = size * y[0] * e1[i];
        w[1][k][i] = size * y[1] * e2[i];
        w[2][k][i] = size * (y[1] * e1[i] + y[0] * e2[i]);
      }
    }
  }

  /// Their scalar products with numbers at the vertices, solved with those among themselves.
  std::array<double, count> coefficients(const double* g) const {
    std::array<double, count * count> mass{};
    std::array<double, count> right{};
    for (int a = 0; a < count; ++a)
      for (int k = 0; k < D; ++k) {
        for (int i = 0; i < D; ++i) right[a] += w[a][k][i] * g[k * D + i];
        for (int b = 0; b < count; ++b) mass[a * count + b] += dot(w[a][k], w[b][k]) / (D * (D + 1));
      }
    return solved(mass, right);
  }
};

}  // namespace

/// The misfit of a traction t is about the sum over both sides of |T| / |F| int_F |t|^2 / mu.
template <int D>
void along_faces(const TrueProblem<D, D>& problem, const FaceNumbers& gradient, FaceNumbers& z) {
  z.assign(gradient.size(), 0);
  for (Index face = 0; face < problem.incidence.faces(); ++face) {
    const auto& sides = problem.incidence.sides[face];
    if (sides.outer() && !problem.outer[problem.outer_of_face[face]].held()) continue;
    double weight = 0;
    for (const Index e : sides.element)
      if (e >= 0) weight += problem.element[e].measure / problem.material[e].mu;
    const double normal = length<D>(problem.element[sides.element[0]].gradient[sides.opposite[0]]);
    const double measure = D * problem.element[sides.element[0]].measure * normal;
    const Tangential<D> along(points_of(problem.mesh, face_vertices<D>(problem.mesh, sides)));
    const auto by = along.coefficients(at<D, D>(gradient, face, 0));
    for (int a = 0; a < Tangential<D>::count; ++a)
      for (int k = 0; k < D; ++k)
        for (int i = 0; i < D; ++i) at<D, D>(z, face, k)[i] += by[a] * along.w[a][k][i] * measure * measure / weight;
  }
}

template void along_faces(const TrueProblem<2, 2>&, const FaceNumbers&, FaceNumbers&);
template void along_faces(const TrueProblem<3, 3>&, const FaceNumbers&, FaceNumbers&);

}  // namespace signorini
