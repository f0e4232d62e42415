// The reference solver itself: optimality, and the same answer as enumeration of all phases.
#include "tests/support/pdas.hpp"

#include <gtest/gtest.h>

#include "tests/core/solver/cases.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

// Tries every choice of free, lower and upper; the admissible one of least energy is the solution.
Eigen::VectorXd enumerate(const DiscreteProblem<1>& problem) {
  const Eigen::MatrixXd A = dense(problem.A);
  const Eigen::VectorXd b = vector(problem.b);
  const auto n = b.size();
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(n, -infinity), upper = -lower, best;
  for (Index slot = 0; slot < problem.constraints.size(); ++slot) {
    lower[problem.constraints.vector[slot]] = problem.constraints.lower[slot];
    upper[problem.constraints.vector[slot]] = problem.constraints.upper[slot];
  }
  double least = infinity;
  int choices = 1;
  for (int i = 0; i < n; ++i) choices *= 3;
  for (int choice = 0; choice < choices; ++choice) {
    Eigen::MatrixXd M = A;
    Eigen::VectorXd r = b;
    bool possible = true;
    for (int i = 0, rest = choice; i < n; ++i, rest /= 3) {
      if (rest % 3 == 0) continue;
      M.row(i).setZero();
      M(i, i) = 1;
      r[i] = rest % 3 == 1 ? lower[i] : upper[i];
      possible = possible && std::isfinite(r[i]);
    }
    if (!possible) continue;
    const Eigen::VectorXd x = M.partialPivLu().solve(r);
    const double slack = 1e-12, e = 0.5 * x.dot(A * x) - b.dot(x);
    if (((x - lower).array() < -slack).any() || ((upper - x).array() < -slack).any() || e >= least) continue;
    least = e;
    best = x;
  }
  return best;
}

TEST(ReferenceSolver, AgreesWithTheEnumerationOfAllPhases) {
  Random random(41);
  for (int trial = 0; trial < 30; ++trial) {
    const auto problem = random_problem<1>(random, 7, 0.9);
    const Reference found = reference(problem);
    const Eigen::VectorXd expected = enumerate(problem);
    ASSERT_LE((found.x - expected).norm(), 1e-10 * (1 + expected.norm())) << trial;
  }
}

template <int B>
void expect_optimal(const Case<B>& c) {
  const Reference found = reference(c.nested.finest());
  const auto& bounds = c.nested.finest().constraints;
  const double size = found.x.cwiseAbs().maxCoeff(), force = found.force.cwiseAbs().maxCoeff();
  for (Index slot = 0; slot < bounds.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Index i = bounds.vector[slot] * B + k;
      ASSERT_GE(found.x[i], bounds.lower[slot * B + k] - 1e-12 * size) << c.name;
      ASSERT_LE(found.x[i], bounds.upper[slot * B + k] + 1e-12 * size) << c.name;
      if (found.state[i] == 0) {
        ASSERT_LE(std::abs(found.force[i]), 1e-9 * force + 1e-14) << c.name;
      }
      if (bounds.lower[slot * B + k] == bounds.upper[slot * B + k]) continue;
      if (found.state[i] < 0) {
        ASSERT_GE(found.force[i], -1e-9 * force - 1e-14) << c.name;
      }
      if (found.state[i] == 1) {
        ASSERT_LE(found.force[i], 1e-9 * force + 1e-14) << c.name;
      }
    }
}

TEST(ReferenceSolver, MeetsTheOptimalityConditions) {
  for (const auto& c : scalar_cases()) expect_optimal(c);
  for (const auto& c : plane_cases()) expect_optimal(c);
  for (const auto& c : space_cases()) expect_optimal(c);
}

TEST(ReferenceSolver, CasesAreWhatTheyAreCalled) {
  for (const auto& c : scalar_cases()) {
    const Reference found = reference(c.nested.finest());
    const int bounded = c.nested.finest().constraints.size();
    if (c.name == "no_contact") {
      EXPECT_EQ(found.active(), 0);
    }
    if (c.name == "full_contact") {
      EXPECT_EQ(found.active(), bounded);
    }
    if (c.name == "two_sided" || c.name == "radial2" || c.name == "radial3" || c.name == "hill") {
      EXPECT_GT(found.active(), 0) << c.name;
      EXPECT_LT(found.active(), bounded) << c.name;
    }
    if (c.name == "two_sided") {
      int lower = 0, upper = 0;
      for (const int s : found.state) {
        lower += s == -1;
        upper += s == 1;
      }
      EXPECT_GT(upper, 0);
    }
  }
  for (const auto& c : plane_cases()) {
    const Reference found = reference(c.nested.finest());
    EXPECT_GT(found.active(), 0) << c.name;
    if (c.name != "block") {
      EXPECT_LT(found.active(), c.nested.finest().constraints.size()) << c.name;
    }
  }
}

}  // namespace
}  // namespace signorini::test
