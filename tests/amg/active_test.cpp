// Multipliers are zero off contact, and active sets are those of the solution.
#include <gtest/gtest.h>

#include "amg/black_box.hpp"
#include "tests/amg/membrane.hpp"

namespace signorini::test {
namespace {

TEST(Active, MultipliersAreZeroOffContactAndHaveTheSignOfTheirBound) {
  const Membrane m;
  const BlackBox::Result result = BlackBox(m.A).solve(m.b, m.lower, m.upper);
  ASSERT_TRUE(result.summary.converged());
  ASSERT_EQ(result.active.size(), m.n);
  const Eigen::VectorXd force = m.A * vector(result.x) - vector(m.b);
  int at_lower = 0, at_upper = 0, free = 0;
  for (std::size_t i = 0; i < m.n; ++i) {
    const double f = force[static_cast<Eigen::Index>(i)];
    if (m.lower[i] == m.upper[i]) {
      EXPECT_NEAR(result.multiplier[i], f, 1e-12);
      EXPECT_EQ(result.active[i], f < 0 ? 1 : -1);
      continue;
    }
    at_lower += result.x[i] == m.lower[i];
    at_upper += result.x[i] == m.upper[i];
    free += result.active[i] == 0;
    EXPECT_EQ(result.active[i], result.x[i] == m.lower[i] ? -1 : result.x[i] == m.upper[i] ? 1 : 0) << i;
    EXPECT_TRUE(result.active[i] != 0 || result.multiplier[i] == 0) << i << ": " << result.multiplier[i];
    EXPECT_LE(result.active[i] * result.multiplier[i], 0) << i;
    EXPECT_NEAR(result.multiplier[i], f, 1e-9) << i;
  }
  EXPECT_GT(at_lower, 0);
  EXPECT_GT(at_upper, 0);
  EXPECT_GT(free, 0);
}

// Where a bound is met without force rounding has either sign.
TEST(Active, BoundsThatAreTouchedWithoutForcePullAtNothing) {
  const Membrane m;
  const Eigen::VectorXd b = m.A * vector(m.lower);
  const BlackBox::Result result = BlackBox(m.A).solve(std::vector<double>(b.begin(), b.end()), m.lower);
  for (const double force : result.multiplier) EXPECT_GE(force, 0);
}

TEST(Active, ZeroRowsGoToTheirBounds) {
  Eigen::SparseMatrix<double> A(3, 3);
  A.insert(1, 1) = 2;
  const std::vector<double> lower(3, -1), upper(3, 4);
  const BlackBox::Result result = BlackBox(A).solve(std::vector<double>{3, 2, -5}, lower, upper);
  EXPECT_EQ(result.multiplier, (std::vector<double>{-3, 0, 5}));
  EXPECT_EQ(result.active, (std::vector<signed char>{1, 0, -1}));
}

}  // namespace
}  // namespace signorini::test
