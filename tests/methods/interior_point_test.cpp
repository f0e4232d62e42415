// Interior points and shifted active sets, which method "auto" falls back to: the reference solution, whatever the
// signs of the couplings, and no answer where there is none.
#include "methods/interior_point.hpp"

#include <gmock/gmock.h>

#include "methods/active_set.hpp"
#include "tests/core/solver/cases.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

template <int B>
Summary by_interior_points(const DiscreteProblem<B>& problem, std::vector<double>& x, int most = 60) {
  SolverOptions options;
  options.max_iterations = most;
  x = problem.start;
  return InteriorPointIteration<B>(problem, x, options, registry(), "cholmod").run({});
}

template <int B>
void expect_solved(const DiscreteProblem<B>& problem) {
  std::vector<double> x;
  const Summary summary = by_interior_points(problem, x);
  ASSERT_TRUE(summary.converged()) << summary.reason;
  EXPECT_LE(summary.iterations, 40);
  const Reference exact = reference(problem);
  EXPECT_LE(energy_norm<B>(problem.A, vector(x) - exact.x), 1e-8 * energy_norm<B>(problem.A, exact.x) + 1e-14);
}

template <int B>
void expect_solved(const std::vector<Case<B>>& cases) {
  for (const Case<B>& c : cases) {
    SCOPED_TRACE(c.name);
    expect_solved(c.nested.finest());
  }
}

TEST(InteriorPoint, FindsTheReferenceSolution) {
  expect_solved(scalar_cases());
  expect_solved(plane_cases());
  expect_solved(space_cases());
}

TEST(InteriorPoint, SolvesEveryRandomBox) {
  Random random(52);
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    expect_solved(random_problem<3>(random, 20, 0.6));
  }
}

// Two unknowns tied together by a spring, in the box [-1, 1] or above -1 alone.
DiscreteProblem<1> floating(double load, double upper) {
  DiscreteProblem<1> problem;
  problem.A.row = {0, 2, 4};
  problem.A.column = {0, 1, 1, 0};
  problem.A.value = {1, -1, 1, -1};
  problem.constraints.slot = problem.constraints.vector = {0, 1};
  problem.constraints.lower = {-1, -1};
  problem.constraints.upper = {upper, upper};
  problem.b = {load, 0.25};
  problem.fixed = {0, 0};
  problem.start = {0, 0};
  problem.segments = {{0, 2, std::make_shared<Box<1>>()}};
  return problem;
}

TEST(InteriorPoint, SemidefiniteMatricesAreSolvedWhereTheBoundsHold) {
  std::vector<double> x;
  EXPECT_TRUE(by_interior_points(floating(0.5, 1), x).converged());
  EXPECT_THAT(x, testing::ElementsAre(1, 1));
  EXPECT_TRUE(by_interior_points(floating(-0.5, infinity), x).converged());
  EXPECT_THAT(x, testing::ElementsAre(-1, testing::DoubleNear(-0.75, 1e-7)));
  EXPECT_TRUE(by_interior_points(floating(-0.25, infinity), x).converged()) << "loads that balance";
  EXPECT_NEAR(x[1] - x[0], 0.25, 1e-7);
  EXPECT_FALSE(by_interior_points(floating(0.5, infinity), x).converged()) << "falls for ever";
  DiscreteProblem<1> nothing = floating(0, 1);
  nothing.b = {0, 0};
  EXPECT_TRUE(by_interior_points(nothing, x).converged());
  EXPECT_THAT(x, testing::ElementsAre(0, 0));
}

TEST(InteriorPoint, StopsAtTheIterationLimit) {
  std::vector<double> x;
  const auto cases = scalar_cases();
  const Summary summary = by_interior_points(cases.front().nested.finest(), x, 3);
  EXPECT_EQ(summary.outcome, Outcome::iteration_limit);
  EXPECT_EQ(summary.history.size(), 3u);
}

Summary by_shifted_sets(const DiscreteProblem<1>& problem, std::vector<double>& x) {
  const SolverOptions options;
  x = problem.start;
  return ActiveSetIteration<1>(problem, x, options, registry(), "cholmod", 1e-10).run({});
}

TEST(ShiftedActiveSets, NeedNothingThatHoldsTheFreeComponents) {
  std::vector<double> x;
  const Summary balanced = by_shifted_sets(floating(-0.25, infinity), x);
  EXPECT_TRUE(balanced.converged()) << balanced.reason;
  EXPECT_NEAR(x[1] - x[0], 0.25, 1e-12);
  EXPECT_TRUE(by_shifted_sets(floating(-0.5, infinity), x).converged());
  EXPECT_THAT(x, testing::ElementsAre(-1, testing::DoubleNear(-0.75, 1e-12)));
  const Summary falling = by_shifted_sets(floating(0.5, infinity), x);
  EXPECT_EQ(falling.outcome, Outcome::stuck);
  EXPECT_THAT(falling.reason, testing::HasSubstr("nothing holds"));
}

// Whatever holds them where all bounds are active: they stay next to the start, and do not come to rest far away.
TEST(ShiftedActiveSets, LeaveWhatNothingHoldsWhereItIs) {
  DiscreteProblem<1> problem = floating(-0.25, infinity);
  problem.constraints.lower = {-1000, -1000};
  std::vector<double> x;
  const Summary balanced = by_shifted_sets(problem, x);
  EXPECT_TRUE(balanced.converged()) << balanced.reason;
  EXPECT_NEAR(x[1] - x[0], 0.25, 1e-14);
  EXPECT_LT(std::abs(x[0]), 1);
}

}  // namespace
}  // namespace signorini::test
