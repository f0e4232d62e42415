#pragma once
#include "estimators/flux.hpp"
#include "estimators/split_stress.hpp"

namespace signorini {

/// One element, with the map x = F x^ from the reference simplex: z^ = J F^-1 z of tractions z = t |F|,
/// f^ = J^2 F^-1 f of forces, tau = F tau^ F' / J^2 of stresses.
template <int D>
class StressElement {
 public:
  using Stress = SplitStress<D>;
  using FaceValues = std::array<std::array<std::array<double, D>, D>, D + 1>;  // per face, vertex and component
  using Tensor = Gradient<D, D>;

  StressElement(const LinearElement<D>& element, const std::array<Point<D>, D + 1>& corner)
      : element_(element), J_((D == 2 ? 2 : 6) * element.measure) {
    for (int k = 0; k < D; ++k) {
      const Point<D> edge = difference<D>(corner[k + 1], corner[0]);
      for (int i = 0; i < D; ++i) F_[i][k] = edge[i];
    }
  }

  /// 1/2 int (tau - s) : C^-1 (tau - s), for s linear in the element.
  /// @param z becomes the gradient by the tractions
  double misfit(const Material<D>& material, const std::array<Tensor, D + 1>& s, const Point<D>& force,
                FaceValues& z) const {
    Eigen::Matrix<double, Stress::data, 1> given;
    for (int k = 0; k <= D; ++k)
      for (int m = 0; m < D; ++m)
        for (int i = 0; i < D; ++i) given[Stress::column(k, m, i)] = J_ * dot(element_.gradient[i + 1], z[k][m]);
    for (int i = 0; i < D; ++i) given[Stress::tractions + i] = J_ * J_ * dot(element_.gradient[i + 1], force);
    Eigen::Matrix<double, Stress::stresses, 1> stress = Stress::reference() * given;

    Tensor middle{};
    for (const Tensor& at_vertex : s) add(1.0 / (D + 1), at_vertex, middle);
    double energy = 0;
    for (int part = 0; part <= D; ++part) energy += of_part(material, s, middle, part, stress);

    const Eigen::Matrix<double, Stress::tractions, 1> slope =
        Stress::reference().template leftCols<Stress::tractions>().transpose() * stress;
    for (int k = 0; k <= D; ++k)
      for (int m = 0; m < D; ++m) {
        z[k][m].fill(0);
        for (int r = 0; r < D; ++r)
          for (int i = 0; i < D; ++i) z[k][m][i] += J_ * slope[Stress::column(k, m, r)] * element_.gradient[r + 1][i];
      }
    return energy;
  }

 private:
  /// On one part, where all is linear; its stresses become the gradient by them.
  double of_part(const Material<D>& material, const std::array<Tensor, D + 1>& s, const Tensor& middle, int part,
                 Eigen::Matrix<double, Stress::stresses, 1>& stress) const {
    const double mass = element_.measure / ((D + 1) * (D + 1) * (D + 2));
    std::array<Tensor, D + 1> w;
    Tensor sum{};
    for (int q = 0; q <= D; ++q) {
      w[q] = forth(stress, part, q);
      add(-1, q == part ? middle : s[q], w[q]);
      add(1, w[q], sum);
    }
    double energy = mass / 2 * contract(sum, strain_of(material, sum));
    for (int q = 0; q <= D; ++q) {
      Tensor y = strain_of(material, w[q]);
      energy += mass / 2 * contract(w[q], y);
      add(1, sum, w[q]);
      y = strain_of(material, w[q]);
      back(mass, y, part, q, stress);
    }
    return energy;
  }

  Tensor forth(const Eigen::Matrix<double, Stress::stresses, 1>& stress, int part, int q) const {
    Tensor tau, half{};
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) tau[i][j] = stress[Stress::row(part, q, Stress::component(i, j))] / (J_ * J_);
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k)
        for (int j = 0; j < D; ++j) half[i][j] += F_[i][k] * tau[k][j];
    Tensor out{};
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        for (int k = 0; k < D; ++k) out[i][j] += half[i][k] * F_[j][k];
    return out;
  }

  void back(double factor, const Tensor& y, int part, int q, Eigen::Matrix<double, Stress::stresses, 1>& out) const {
    Tensor half{};
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k)
        for (int j = 0; j < D; ++j) half[i][j] += F_[k][i] * y[k][j];
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) {
        double sum = 0;
        for (int k = 0; k < D; ++k) sum += half[i][k] * F_[k][j];
        out[Stress::row(part, q, Stress::component(i, j))] = (i == j ? 1 : 2) * factor / (J_ * J_) * sum;
      }
  }

  const LinearElement<D>& element_;
  double J_;
  Tensor F_;
};

}  // namespace signorini
