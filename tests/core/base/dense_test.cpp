#include "core/base/dense.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace signorini {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The third column is the sum of the others.
MatrixXd dependent() {
  MatrixXd A(4, 3);
  A << 1, 2, 3, 0, 1, 1, 2, -1, 1, 4, 0, 4;
  return A;
}

TEST(Dense, EigenpairsAscendAndMakeTheMatrix) {
  MatrixXd H(3, 3);
  H << 2, 1, 0, 1, 2, 0, 0, 0, -5;
  const auto [values, vectors] = eigenpairs(H);
  EXPECT_NEAR((values - Eigen::Vector3d(-5, 1, 3)).norm(), 0, 1e-13);
  EXPECT_NEAR((vectors * values.asDiagonal() * vectors.transpose() - H).norm(), 0, 1e-13);
}

TEST(Dense, WhatIsNoNumberStaysNone) {
  MatrixXd H = MatrixXd::Identity(3, 3);
  H(1, 1) = std::numeric_limits<double>::quiet_NaN();
  const auto [values, vectors] = eigenpairs(H);
  ASSERT_EQ(values.size(), 3);
  EXPECT_TRUE(values.array().isNaN().all());
  EXPECT_TRUE(vectors.array().isNaN().all());
}

TEST(Dense, DependentColumnsAreSeen) {
  const MatrixXd A = dependent();
  const VectorXd b = VectorXd::LinSpaced(4, -1, 3);
  const LeastSquares nearest = least_squares(A, b, 1e-10);
  EXPECT_EQ(nearest.rank, 2);
  EXPECT_NEAR((A.transpose() * (A * nearest.x - b)).norm(), 0, 1e-13);
  EXPECT_NEAR((A - nearest.range * (nearest.range.transpose() * A)).norm(), 0, 1e-13);
  const MatrixXd none = null_space(A, 1e-10);
  ASSERT_EQ(none.cols(), 1);
  EXPECT_NEAR((A * none).norm(), 0, 1e-13);
  const VectorXd smallest = smallest_solution(A, b);
  EXPECT_NEAR((A.transpose() * (A * smallest - b)).norm(), 0, 1e-13);
  EXPECT_NEAR(std::abs((none.transpose() * smallest)[0]), 0, 1e-13) << "nothing of it is in vain";
}

TEST(Dense, FactorsMakeTheMatrix) {
  const MatrixXd A = dependent().leftCols(2), H = A.transpose() * A;
  EXPECT_NEAR((cholesky(H) * cholesky(H).transpose() - H).norm(), 0, 1e-13);
  const MatrixXd Q = orthonormal_columns(A), R = triangular_factor(A);
  EXPECT_NEAR((Q * R - A).norm(), 0, 1e-13);
  EXPECT_NEAR((H * SymmetricFactors(H).solve(A.transpose()) - A.transpose()).norm(), 0, 1e-13);
  const VectorXd values = singular_values(A);
  EXPECT_NEAR(values.squaredNorm(), A.squaredNorm(), 1e-13);
  EXPECT_GE(values[0], values[1]);
}

}  // namespace
}  // namespace signorini
