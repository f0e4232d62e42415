#include "estimators/certificate/split_stress.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace signorini::test {
namespace {

/// The stress is unique: of the tractions and the force of a linear stress it makes that one.
template <int D>
void expect_linear_stresses() {
  using Stress = SplitStress<D>;
  using Vector = Eigen::Matrix<double, D, 1>;
  using Tensor = Eigen::Matrix<double, D, D>;
  std::array<Vector, D + 1> vertex, gradient;
  vertex[0].setZero();
  gradient[0] = -Vector::Ones();
  for (int i = 0; i < D; ++i) vertex[i + 1] = gradient[i + 1] = Vector::Unit(i);
  std::array<Tensor, D + 1> value;
  std::srand(7);
  for (Tensor& s : value) {
    const Tensor any = Tensor::Random();
    s = any + any.transpose();
  }
  Eigen::Matrix<double, Stress::data, 1> given;
  Vector force = Vector::Zero();
  const double measure = D == 2 ? 0.5 : 1.0 / 6;
  for (int s = 0; s <= D; ++s) {
    force -= value[s] * gradient[s];
    for (int q = 0, k = 0; q <= D; ++q) {
      if (q == s) continue;
      const Vector t = -D * measure * value[q] * gradient[s];
      for (int i = 0; i < D; ++i) given[Stress::column(s, k, i)] = t[i];
      ++k;
    }
  }
  for (int i = 0; i < D; ++i) given[Stress::tractions + i] = force[i];
  const Eigen::Matrix<double, Stress::stresses, 1> found = Stress::reference() * given;
  Tensor middle = Tensor::Zero();
  for (const Tensor& s : value) middle += s / (D + 1);
  for (int s = 0; s <= D; ++s)
    for (int q = 0; q <= D; ++q)
      for (int i = 0; i < D; ++i)
        for (int j = i; j < D; ++j)
          EXPECT_NEAR(found[Stress::row(s, q, Stress::component(i, j))], (q == s ? middle : value[q])(i, j), 1e-12);
}

TEST(SplitStress, MakesLinearStressesOfTheirTractions) {
  expect_linear_stresses<2>();
  expect_linear_stresses<3>();
}

}  // namespace
}  // namespace signorini::test
