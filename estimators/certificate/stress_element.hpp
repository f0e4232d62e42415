#pragma once
#include "estimators/certificate/flux.hpp"
#include "estimators/certificate/split_stress.hpp"

namespace signorini {

/// The stress of SplitStress on one element, all in terms of the reference simplex, x = F x^ + x_0: tractions z = t |F|
/// become z^ = J F^-1 z, forces f^ = J^2 F^-1 f, stresses s^ = J^2 F^-1 s F^-T, and with C = F'F
///     s : C_mu^-1 : s = (tr(C s^ C s^) / (2 mu) - lambda / (2 mu (2 mu + D lambda)) (C : s^)^2) / J^4.
template <int D>
class StressElement {
 public:
  using Stress = SplitStress<D>;
  using FaceValues = std::array<std::array<std::array<double, D>, D>, D + 1>;  // per face, vertex and component
  using Tensor = Gradient<D, D>;

  StressElement(const LinearElement<D>& element, const std::array<Point<D>, D + 1>& corner)
      : element_(element), J_((D == 2 ? 2 : 6) * element.measure) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        C_[i][j] = dot(difference<D>(corner[i + 1], corner[0]), difference<D>(corner[j + 1], corner[0]));
  }

  /// 1/2 int (tau - s) : C_mu^-1 (tau - s), for s linear in the element.
  /// @param z values of tau . n out of each face, times its measure, at its vertices: become the gradient by them
  double misfit(const Material<D>& material, const std::array<Tensor, D + 1>& s, const Point<D>& force,
                FaceValues& z) const {
    const Stresses G = energy_of(material);
    Values w = stress_of(z, force) - reference_stress(s);
    const Values strain = G * w;
    const double mass = element_.measure / ((D + 1) * (D + 1) * (D + 2));  // of a point, in its part
    double energy = w.cwiseProduct(strain).sum();
    for (int part = 0; part <= D; ++part) {
      const Component sum = strain.template middleCols<D + 1>(part * (D + 1)).rowwise().sum();
      energy += w.template middleCols<D + 1>(part * (D + 1)).rowwise().sum().dot(sum);
      w.template middleCols<D + 1>(part * (D + 1)) =
          mass * (strain.template middleCols<D + 1>(part * (D + 1)).colwise() + sum);
    }
    gradient_of(w, z);
    return mass / 2 * energy;
  }

 private:
  static constexpr int points = (D + 1) * (D + 1);
  using Component = Eigen::Matrix<double, Stress::components, 1>;
  using Stresses = Eigen::Matrix<double, Stress::components, Stress::components>;
  using Values = Eigen::Matrix<double, Stress::components, points>;  // a column for each row() / components

  Values stress_of(const FaceValues& z, const Point<D>& force) const {
    Eigen::Matrix<double, Stress::data, 1> given;
    for (int i = 0; i < D; ++i) {
      const Point<D>& g = element_.gradient[i + 1];  // a row of F^-1
      for (int k = 0; k <= D; ++k)
        for (int m = 0; m < D; ++m) given[Stress::column(k, m, i)] = J_ * dot(g, z[k][m]);
      given[Stress::tractions + i] = J_ * J_ * dot(g, force);
    }
    Values out;
    Eigen::Map<Eigen::Matrix<double, Stress::stresses, 1>>(out.data()).noalias() = operator_ * given;
    return out;
  }

  void gradient_of(const Values& by_stress, FaceValues& z) const {
    const Eigen::Matrix<double, Stress::data, 1> slope =
        operator_.transpose() * Eigen::Map<const Eigen::Matrix<double, Stress::stresses, 1>>(by_stress.data());
    for (int k = 0; k <= D; ++k)
      for (int m = 0; m < D; ++m)
        for (int i = 0; i < D; ++i) {
          z[k][m][i] = 0;
          for (int r = 0; r < D; ++r) z[k][m][i] += J_ * slope[Stress::column(k, m, r)] * element_.gradient[r + 1][i];
        }
  }

  /// At the points of all parts: vertices, and the centroid.
  Values reference_stress(const std::array<Tensor, D + 1>& s) const {
    Eigen::Matrix<double, Stress::components, D + 1> at_vertex;
    for (int q = 0; q <= D; ++q)
      for (int j = 0; j < D; ++j) {
        const Point<D> along = applied(s[q], element_.gradient[j + 1]);
        for (int i = 0; i <= j; ++i)
          at_vertex(Stress::component(i, j), q) = J_ * J_ * dot(element_.gradient[i + 1], along);
      }
    const Component middle = at_vertex.rowwise().mean();
    Values out;
    for (int part = 0; part <= D; ++part) {
      out.template middleCols<D + 1>(part * (D + 1)) = at_vertex;
      out.col(part * (D + 1) + part) = middle;
    }
    return out;
  }

  /// The quadratic form above on components: those off the diagonal count twice.
  Stresses energy_of(const Material<D>& material) const {
    const double shear = 1 / (2 * material.mu * J_ * J_ * J_ * J_);
    const double pressure = shear * material.lambda / (2 * material.mu + D * material.lambda);
    Stresses G;
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j)
        for (int k = 0; k < D; ++k)
          for (int l = k; l < D; ++l)
            G(Stress::component(i, j), Stress::component(k, l)) =
                (i == j ? 1 : 2) * (k == l ? 1 : 2) *
                (shear / 2 * (C_[i][k] * C_[j][l] + C_[i][l] * C_[j][k]) - pressure * C_[i][j] * C_[k][l]);
    return G;
  }

  const LinearElement<D>& element_;
  const typename Stress::Operator& operator_ = Stress::reference();
  double J_;
  Tensor C_;
};

}  // namespace signorini
