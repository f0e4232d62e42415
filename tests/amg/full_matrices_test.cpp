// Matrices that cannot be coarsened: active sets solve them after a few cycles of sweeps, unless sweeps do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amg/black_box.hpp"
#include "tests/amg/matrices.hpp"

namespace signorini::test {
namespace {

/// Of a smooth kernel: all couplings positive, with an ill-conditioned matrix.
Eigen::MatrixXd kernel(int n, double width, double shift) {
  Eigen::MatrixXd A = shift * Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) A(i, j) += std::exp(-std::pow((i - j) / (width * n), 2));
  return A;
}

/// Largest violation of the conditions for x >= 0 over |b|.
double violation(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& x) {
  const Eigen::VectorXd force = A * x - b;
  EXPECT_GE(x.minCoeff(), 0);
  double worst = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) worst = std::max(worst, x[i] > 0 ? std::abs(force[i]) : -force[i]);
  return worst / b.norm();
}

TEST(FullMatrices, GoToActiveSetsAfterAFewCycles) {
  const int n = 600;
  const Eigen::MatrixXd A = kernel(n, 0.1, 1e-4);
  std::vector<double> b = waves(n);
  const std::vector<double> lower(n, 0);
  const auto result = BlackBox(Eigen::SparseMatrix<double>(A.sparseView()), 1).solve(b, lower);
  EXPECT_TRUE(result.summary.converged()) << result.summary.reason;
  EXPECT_THAT(result.summary.options.method, testing::HasSubstr("pdas"));
  EXPECT_LE(result.summary.iterations, 25);
  EXPECT_LE(violation(A, vector(b), vector(result.x)), 1e-6);
}

TEST(FullMatrices, AreLeftToSweepsWhereTheseDo) {
  const int n = 600;
  const Eigen::MatrixXd A = kernel(n, 0.002, 1);
  std::vector<double> b = waves(n);
  const std::vector<double> lower(n, 0);
  // So that as many couple as in a full matrix.
  const Eigen::MatrixXd full = A + 1e-12 * Eigen::MatrixXd::Ones(n, n);
  const auto result = BlackBox(Eigen::SparseMatrix<double>(full.sparseView()), 1).solve(b, lower);
  EXPECT_TRUE(result.summary.converged()) << result.summary.reason;
  EXPECT_THAT(result.summary.options.method, testing::Not(testing::HasSubstr("pdas")));
  EXPECT_LE(result.summary.iterations, 5);
  EXPECT_LE(violation(full, vector(b), vector(result.x)), 1e-6);
}

}  // namespace
}  // namespace signorini::test
