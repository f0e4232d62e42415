// What a summary says about the methods that ran: what each did, why it was left, and what counts for the limit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "amg/registration.hpp"
#include "core/algebra/linear_solver.hpp"
#include "core/base/error.hpp"
#include "core/solver/convergence.hpp"
#include "methods/stages.hpp"
#include "smoothers/registration.hpp"
#include "tests/core/solver/cases.hpp"
#include "transfer/registration.hpp"

namespace signorini::test {
namespace {

/// Cells of 25 to 1 that bend: cycles are slow.
Nested<2> slow() {
  Model<2> model = resting_block<2>({0, -1e-6}, {});
  model.obstacles.front() = {plane<2>({0, -0.5}, {0, 1}), on("bottom"), "test"};
  model.fixes = {{on("left"), {Field(0), Field(0)}}};
  Mesh<2> mesh = cube<2>(0, 1, 4);
  for (auto& point : mesh.points) point[0] *= 100;
  return discretize_all<2, 2>(mesh, 3, model);
}

int all_iterations(const Summary& s) {
  return std::accumulate(s.stages.begin(), s.stages.end(), 0,
                         [](int sum, const Stage& stage) { return sum + stage.iterations; });
}

TEST(Stages, OneMethodIsOneStage) {
  const auto cases = scalar_cases();
  std::vector<double> x;
  for (const char* method : {"monotone", "pdas"}) {
    SolverOptions options;
    options.method = method;
    const Summary s = solve_from_zero(cases.front().nested, x, options);
    ASSERT_EQ(s.stages.size(), 1u);
    const Stage& stage = s.stages.front();
    EXPECT_EQ(stage.method, method);
    EXPECT_EQ(stage.iterations, s.iterations);
    EXPECT_EQ(stage.outcome, Outcome::converged);
    EXPECT_EQ(stage.reason, s.reason);
    EXPECT_TRUE(stage.kept);
    EXPECT_EQ(s.history.size(), static_cast<std::size_t>(s.iterations));
    const bool linear = stage.method == "pdas";
    EXPECT_EQ(stage.linear, linear ? "cholmod" : "");
    EXPECT_EQ(stage.linear_solves, linear ? s.iterations : 0);
    EXPECT_EQ(stage.factorisations > 0, linear);
    EXPECT_LE(stage.factorisations, stage.linear_solves);
  }
}

TEST(Stages, OfAFallBackAreCountedAndNumbered) {
  const auto nested = slow();
  std::vector<double> x;
  const Summary s = solve_from_zero(nested, x);
  ASSERT_TRUE(s.converged()) << s.reason;
  ASSERT_EQ(s.stages.size(), 2u);
  const Stage &cycles = s.stages[0], &sets = s.stages[1];
  EXPECT_EQ(cycles.outcome, Outcome::stuck);
  EXPECT_THAT(cycles.reason, testing::HasSubstr("slow"));
  EXPECT_GT(cycles.iterations, 0);
  EXPECT_EQ(sets.method, "pdas");
  EXPECT_EQ(sets.iterations, 0) << "no cycles";
  EXPECT_GT(sets.linear_solves, 1);
  EXPECT_GE(sets.linear_solves, sets.factorisations);
  EXPECT_EQ(s.iterations, cycles.iterations);
  EXPECT_EQ(all_iterations(s), s.iterations);
  const auto steps = static_cast<int>(s.history.size()) - cycles.iterations;
  EXPECT_GT(steps, 1) << "of active sets, each of them";
  EXPECT_LE(steps, sets.linear_solves);
  for (std::size_t k = 0; k < s.history.size(); ++k) {
    EXPECT_EQ(s.history[k].iteration, static_cast<int>(k) + 1);
    EXPECT_EQ(s.history[k].stage, k < static_cast<std::size_t>(s.iterations) ? 0u : 1u);
    EXPECT_EQ(s.history[k].levels.size(), s.level_unknowns.size());
  }
  EXPECT_EQ(s.history.back().energy, s.energy);
}

// Cycles and the steps of what follows count together.
TEST(Stages, TheLimitIsThatOfAllSteps) {
  const auto nested = slow();
  std::vector<double> x;
  const int all = static_cast<int>(solve_from_zero(nested, x).history.size());
  SolverOptions options;
  // With one step for what follows the cycles, none of it can do.
  for (const int limit : {all, automatic::patience_with_cycles.first + 1}) {
    options.max_iterations = limit;
    const Summary s = solve_from_zero(nested, x, options);
    EXPECT_LE(s.history.size(), static_cast<std::size_t>(limit));
    EXPECT_LE(s.iterations, limit);
    EXPECT_EQ(s.converged(), limit == all) << limit << " steps: " << s.reason;
    EXPECT_TRUE(limit == all || s.outcome == Outcome::iteration_limit) << s.reason;
  }
}

// A registry without the direct solver, and one where it has no memory.
TEST(Stages, SayWhyAFallBackFailed) {
  const auto nested = slow();
  for (const bool missing : {true, false}) {
    Registry own;
    register_smoothers(own);
    register_transfers(own);
    register_coarse_solvers(own);
    own.add<LinearSolver>({"linear", "cholmod", "", {}, "", {}}, [=]() -> std::unique_ptr<LinearSolver> {
      if (missing) throw Error(Exit::input, "libsignorini_cholmod.so is not there");
      throw std::bad_alloc();
    });
    SolverOptions options;
    options.max_iterations = 100;
    std::vector<double> x(nested.finest().b.size(), 0.0);
    const Summary s = solve<2>(nested.finest(), nested.prolongations, x, options, own);
    ASSERT_GE(s.stages.size(), 3u);
    for (const std::size_t k : {1, 2}) {
      EXPECT_EQ(s.stages[k].outcome, Outcome::failed);
      EXPECT_FALSE(s.stages[k].kept);
      EXPECT_EQ(s.stages[k].linear, "cholmod");
      EXPECT_THAT(s.stages[k].reason, testing::HasSubstr(missing ? "not there" : "memory"));
    }
    EXPECT_EQ(s.stages[3].method, "newton");
    EXPECT_LE(all_iterations(s), 100);
  }
}

TEST(Stages, RatesThatAreNotKnownAreNotNumbers) {
  ErrorEstimate estimate;
  EXPECT_TRUE(std::isnan(estimate.rate()));
  estimate.add(1, 1);
  EXPECT_TRUE(std::isnan(estimate.rate()));
  estimate.add(0, 0);
  EXPECT_TRUE(std::isnan(estimate.rate())) << "one correction above rounding";
  ErrorEstimate other;
  for (const double correction : {1.0, 0.5, 0.25}) other.add(correction * correction, correction);
  EXPECT_DOUBLE_EQ(other.rate(), 0.5);
  other.add(0, 0);
  EXPECT_DOUBLE_EQ(other.rate(), 0.5) << "rounding has no rate";
}

}  // namespace
}  // namespace signorini::test
