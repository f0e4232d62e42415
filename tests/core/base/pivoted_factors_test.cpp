#include "core/base/pivoted_factors.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "tests/support/random.hpp"

namespace signorini {
namespace {

constexpr int n = 6;

/// A matrix of this rank, rows and columns in units of their own.
std::array<std::array<double, n>, n> matrix(test::Random& random, int rank) {
  Eigen::Matrix<double, n, n> B = Eigen::Matrix<double, n, n>::Zero();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < rank; ++j) B(i, j) = std::pow(10.0, i) * random.between(-1, 1);
  const Eigen::Matrix<double, n, n> H = B * B.transpose();
  std::array<std::array<double, n>, n> out;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) out[i][j] = H(i, j);
  return out;
}

TEST(PivotedFactors, SolveWhatIsDefinite) {
  test::Random random(5);
  for (int k = 0; k < 20; ++k) {
    const auto H = matrix(random, n);
    std::array<double, n> x, b{};
    for (double& v : x) v = random.between(-1, 1);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) b[i] += H[i][j] * x[j];
    const PivotedFactors<n> factors(H);
    EXPECT_TRUE(factors.definite(1e-16));
    const auto found = factors.solve(b);
    for (int i = 0; i < n; ++i) {
      double r = b[i], size = std::abs(b[i]);
      for (int j = 0; j < n; ++j) {
        r -= H[i][j] * found[j];
        size += std::abs(H[i][j] * found[j]);
      }
      EXPECT_NEAR(r, 0, 1e-13 * size) << i;
    }
  }
}

TEST(PivotedFactors, SeeWhatIsNot) {
  test::Random random(5);
  for (const int rank : {0, 1, 3, 5}) EXPECT_FALSE(PivotedFactors<n>(matrix(random, rank)).definite(1e-14)) << rank;
}

}  // namespace
}  // namespace signorini
