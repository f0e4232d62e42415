// Nested iteration on algebraic levels: the contact set need not grow by a layer of vectors per cycle.
#include "amg/black_box/nested_start.hpp"

#include <gtest/gtest.h>

#include "amg/coarsening/hierarchy.hpp"
#include "core/base/error.hpp"
#include "tests/core/solver/cases.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

template <int B>
std::vector<Prolongation> hierarchy(const DiscreteProblem<B>& problem) {
  return algebraic_hierarchy<B>(
             problem, [] { return registry().create<Transfer<B>>("transfer", "min_merge"); }, 50)
      .prolongations;
}

DiscreteProblem<1> pressed_membrane(int cells) {
  const auto lower = [](const double* x) { return -0.02 - 0.1 * (x[0] - 0.3) * (x[0] - 0.3); };
  return discretize<2, 1>(cube<2>(0, 1, cells), membrane(-1, lower, {})).problem;
}

TEST(NestedStart, SavesAThirdOfTheCyclesOfALargeContactSet) {
  const auto problem = pressed_membrane(256);
  const auto P = hierarchy(problem);
  const auto cycles = [&](std::vector<double> x) { return solve<1>(problem, P, x, {}, registry()).iterations; };
  const int from_start = cycles(nested_start<1>(problem, P, {}, registry())), from_zero = cycles(problem.start);
  EXPECT_LE(3 * from_start, 2 * from_zero);
}

/// Relative error in the energy norm of the start that nested iteration gives.
template <int B>
double start_error(const DiscreteProblem<B>& problem) {
  const auto x = nested_start<B>(problem, hierarchy(problem), {}, registry());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const bool prescribed = problem.fixed[k / B] >> (k % B) & 1u;
    EXPECT_TRUE(!prescribed || x[k] == problem.start[k]) << k;
  }
  const Eigen::VectorXd exact = reference(problem).x;
  return energy_norm<B>(problem.A, vector(x) - exact) / energy_norm<B>(problem.A, exact);
}

TEST(NestedStart, IsNearTheSolution) {
  EXPECT_LE(start_error(pressed_membrane(64)), 0.3);
  for (const auto& c : plane_cases()) EXPECT_LE(start_error(c.nested.finest()), 0.7) << c.name;
}

TEST(NestedStart, KnowsPrescribedValuesThatAMatrixNoLongerHas) {
  const auto lower = [](const double* x) { return 0.7 - (x[0] - 0.3) * (x[0] - 0.3); };
  Model<1> model = membrane(-4, lower, {});
  model.fixes = {{on("boundary"), {field([](const double* x) { return 1 + x[0] * x[1]; })}}};
  EXPECT_LE(start_error(discretize<2, 1>(cube<2>(0, 1, 64), model).problem), 0.08);
}

TEST(NestedStart, ThatFailsIsAStageWithTheReason) {
  const auto problem = pressed_membrane(64);
  const auto P = hierarchy(problem);
  std::vector<Stage> dropped;
  EXPECT_NE(nested_start<1>(problem, P, {}, registry(), {}, &dropped), problem.start);
  EXPECT_TRUE(dropped.empty());
  SolverOptions options;
  options.coarse = "magic";
  EXPECT_EQ(nested_start<1>(problem, P, options, registry(), {}, &dropped), problem.start);
  ASSERT_EQ(dropped.size(), P.size()) << "one for each level that gave none";
  for (const Stage& stage : dropped) {
    EXPECT_EQ(stage.method, "nested start");
    EXPECT_EQ(stage.outcome, Outcome::failed);
    EXPECT_FALSE(stage.kept);
    EXPECT_NE(stage.reason.find("magic"), std::string::npos) << stage.reason;
  }
  Summary summary;
  summary.stages.resize(1);
  summary.history.resize(1);
  summary.put_in_front(dropped);
  EXPECT_EQ(summary.stages.size(), P.size() + 1);
  EXPECT_EQ(summary.history.front().stage, P.size());
}

TEST(NestedStart, WithoutLevelsIsTheProblemsOwn) {
  const auto problem = pressed_membrane(8);
  EXPECT_EQ(nested_start<1>(problem, {}, {}, registry()), problem.start);
}

TEST(NestedStart, DoesWithoutTheLevelsThatFail) {
  const auto problem = pressed_membrane(64);
  const auto P = hierarchy(problem);
  ASSERT_GE(P.size(), 2u);
  const auto start = [&](Index failing, Exit status) {
    return nested_start<1>(problem, P, {}, registry(), [=](const IterationRecord& record) {
      if (record.levels.back().vectors == failing) throw Error(status, "fails");
      return true;
    });
  };
  const Index coarsest = P.front().coarse, finest = P.back().coarse;
  EXPECT_EQ(start(finest, Exit::input), problem.start);
  EXPECT_NE(start(coarsest, Exit::no_solution), problem.start);
  EXPECT_THROW(start(coarsest, Exit::interrupted), Error);
}

}  // namespace
}  // namespace signorini::test
