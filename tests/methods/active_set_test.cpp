// Method "pdas": the reference solution, what it says where it cannot go on, and what it reports.
#include <gmock/gmock.h>

#include "tests/core/solver/cases.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

SolverOptions pdas(double tolerance = 1e-9) {
  SolverOptions options;
  options.method = "pdas";
  options.tolerance = tolerance;
  return options;
}

template <int B>
void expect_solved(const Case<B>& c) {
  const DiscreteProblem<B>& problem = c.nested.finest();
  const Reference exact = reference(problem);
  std::vector<double> x;
  const Summary summary = solve_from_zero(c.nested, x, pdas());
  EXPECT_TRUE(summary.converged()) << c.name << ": " << summary.reason;
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-8 * exact.x.norm()) << c.name;
  EXPECT_EQ(summary.level_unknowns.size(), 1u);
  if (c.name.find("biactive") != std::string::npos) return;  // rounding decides what is active
  if (summary.iterations == 1) return;                       // the start was the solution
  EXPECT_EQ(summary.history.back().changed, 0) << c.name;
  EXPECT_EQ(summary.history.back().levels.front().renewed, 0) << c.name << ": sets at rest need no factorisation";
}

TEST(ActiveSet, ScalarProblemsToTheReferenceSolution) {
  for (const auto& c : scalar_cases()) expect_solved(c);
}
TEST(ActiveSet, PlaneElasticityToTheReferenceSolution) {
  for (const auto& c : plane_cases()) expect_solved(c);
}
TEST(ActiveSet, SpatialElasticityToTheReferenceSolution) {
  for (const auto& c : space_cases()) expect_solved(c);
}

TEST(ActiveSet, NestedStartNeedsFewerSteps) {
  const auto cases = scalar_cases();
  std::vector<double> x;
  const int from_zero = solve_from_zero(cases.front().nested, x, pdas()).iterations;
  EXPECT_LT(solve_nested(cases.front().nested, x, pdas()).iterations, from_zero);
}

// Boxes on every component, random blocks: sets may cycle there, but never without being told.
TEST(ActiveSet, SolvesRandomBoxesOrSaysThatItCycles) {
  Random random(51);
  int solved = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const auto problem = random_problem<3>(random, 20, 0.6);
    std::vector<double> x(problem.b.size(), 0.0);
    const Summary summary = solve<3>(problem, {}, x, pdas(), registry());
    if (summary.outcome == Outcome::stuck) {
      EXPECT_THAT(summary.reason, testing::HasSubstr("cycles"));
      continue;
    }
    ASSERT_TRUE(summary.converged()) << trial << ": " << summary.reason;
    ++solved;
    EXPECT_LE((vector(x) - reference(problem).x).norm(), 1e-8) << trial;
  }
  EXPECT_GE(solved, 30);
}

DiscreteProblem<1> dense_problem(const std::vector<std::vector<double>>& A, std::vector<double> b, double upper) {
  DiscreteProblem<1> problem;
  const auto n = static_cast<Index>(b.size());
  for (Index p = 0; p < n; ++p) {
    problem.A.column.push_back(p);
    problem.A.value.push_back(A[p][p]);
    for (Index q = 0; q < n; ++q)
      if (q != p) {
        problem.A.column.push_back(q);
        problem.A.value.push_back(A[p][q]);
      }
    problem.A.row.push_back(static_cast<Offset>(problem.A.column.size()));
    problem.constraints.slot.push_back(p);
    problem.constraints.vector.push_back(p);
    problem.constraints.lower.push_back(-infinity);
    problem.constraints.upper.push_back(upper);
  }
  problem.b = std::move(b);
  problem.fixed.assign(static_cast<std::size_t>(n), 0);
  problem.start.assign(static_cast<std::size_t>(n), 0);
  problem.segments = {{0, n, std::make_shared<Box<1>>()}};
  return problem;
}

// Symmetric and positive definite; exact arithmetic gives the active sets {1}, {2}, {1, 2, 3}, {1}.
TEST(ActiveSet, DetectsCycling) {
  const auto problem = dense_problem({{9, -3, -4}, {-3, 7, 4}, {-4, 4, 3}}, {3, 0, -1}, 0);
  std::vector<double> x(3, 0.0);
  const Summary summary = solve<1>(problem, {}, x, pdas(), registry());
  EXPECT_EQ(summary.outcome, Outcome::stuck);
  EXPECT_FALSE(summary.converged());
  EXPECT_EQ(summary.iterations, 4);
  EXPECT_EQ(summary.reason, "the active sets of step 1 came back in step 4: the method cycles");
  for (const double value : x) EXPECT_LE(value, 0) << "the result is admissible";

  SolverOptions options;
  EXPECT_TRUE(solve<1>(problem, {}, x, options, registry()).converged()) << "multigrid solves it";
}

// Two unknowns that only the obstacle holds are pushed away from it.
TEST(ActiveSet, SaysWhenNothingHoldsTheFreeComponents) {
  const auto problem = dense_problem({{1, -1}, {-1, 1}}, {-1, 0}, 1);
  std::vector<double> x(2, 0.0);
  const Summary summary = solve<1>(problem, {}, x, pdas(), registry());
  EXPECT_EQ(summary.outcome, Outcome::stuck);
  EXPECT_THAT(summary.reason, testing::HasSubstr("singular"));
}

TEST(ActiveSet, StopsAtTheIterationLimit) {
  auto options = pdas();
  options.max_iterations = 2;
  std::vector<double> x;
  const Summary summary = solve_from_zero(scalar_cases().front().nested, x, options);
  EXPECT_EQ(summary.outcome, Outcome::iteration_limit);
  EXPECT_EQ(summary.history.size(), 2u);
}

}  // namespace
}  // namespace signorini::test
