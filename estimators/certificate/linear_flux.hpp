#pragma once
#include "estimators/certificate/flux.hpp"

namespace signorini {

/// A flux q of lowest order of Brezzi, Douglas and Marini on one element: linear, and given by its linear normal
/// components at the faces. With z_k = |F_k| q . n at the faces opposite to the vertices k, at vertex j it is
///     q(x_j) = sum over k of z_k(x_j) (x_j - x_k) / (D |T|),
/// for q . grad lambda_k = -z_k / (D |T|). Its divergence is constant.
template <int D>
class LinearFlux {
 public:
  using FaceValues = std::array<std::array<std::array<double, 1>, D>, D + 1>;  // per face, vertex and component

  LinearFlux(const LinearElement<D>& element, const std::array<Point<D>, D + 1>& corner)
      : element_(element), corner_(corner) {}

  /// 1/2 int |flux - q|^2 / a, for a flux linear in the element.
  /// @param z values of q . n out of each face, times its measure, at its vertices: become the gradient by them
  double misfit(const Material<1>& material, const std::array<Gradient<D, 1>, D + 1>& flux,
                const std::array<double, 1>&, FaceValues& z) const {
    std::array<Point<D>, D + 1> w;
    Point<D> sum{};
    for (int j = 0; j <= D; ++j) {
      w[j] = at_vertex(j, z);
      for (int i = 0; i < D; ++i) {
        w[j][i] -= flux[j][0][i];
        sum[i] += w[j][i];
      }
    }
    const double mass = element_.measure / ((D + 1) * (D + 2) * material.diffusion);
    double energy = dot(sum, sum);
    for (int j = 0; j <= D; ++j) {
      energy += dot(w[j], w[j]);
      for (int i = 0; i < D; ++i) w[j][i] += sum[i];
      for (int k = 0; k <= D; ++k)
        if (k != j)
          z[k][place(k, j)][0] = mass * dot(w[j], difference<D>(corner_[j], corner_[k])) / (D * element_.measure);
    }
    return mass / 2 * energy;
  }

 private:
  /// Of vertex j among those of the face opposite to k.
  static int place(int k, int j) { return j - (j > k); }

  Point<D> at_vertex(int j, const FaceValues& z) const {
    Point<D> q{};
    for (int k = 0; k <= D; ++k)
      for (int i = 0; i < D && k != j; ++i)
        q[i] += z[k][place(k, j)][0] * (corner_[j][i] - corner_[k][i]) / (D * element_.measure);
    return q;
  }

  const LinearElement<D>& element_;
  const std::array<Point<D>, D + 1> corner_;
};

}  // namespace signorini
