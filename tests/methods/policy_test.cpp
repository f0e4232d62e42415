// The stages of method "auto": the documentation shows the list of the code, and a solve goes through it in its order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "amg/registration.hpp"
#include "core/algebra/linear_solver.hpp"
#include "core/base/error.hpp"
#include "methods/solve.hpp"
#include "methods/stages.hpp"
#include "smoothers/registration.hpp"
#include "tests/support/problems.hpp"
#include "transfer/registration.hpp"

namespace signorini::test {
namespace {

using automatic::Attempt;
using automatic::Situation;

// To renew docs/theory/auto.md after a change of methods/stages.cpp, copy the tables that this test prints.
TEST(Policy, IsTheTablesOfTheDocumentation) {
  std::ifstream file(SIGNORINI_SOURCE_DIR "/docs/theory/auto.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_THAT(text.str(), testing::HasSubstr("\n\n" + automatic::table_of_stages() + "\n"));
  EXPECT_THAT(text.str(), testing::HasSubstr("\n\n" + automatic::table_of_attempts_around() + "\n"));
}

std::vector<std::string> names(const Situation& situation) {
  std::vector<std::string> out;
  for (const Attempt& rule : automatic::stages())
    if (rule.suits(situation)) out.emplace_back(rule.name);
  return out;
}

TEST(Policy, BeginsWithOneKindOfCycles) {
  Situation s{.block = 2, .vectors = 1001, .coarsest_vectors = 1001, .unknowns = 2002, .coarsest = 2002};
  s.newton = true;
  EXPECT_EQ(names(s).front(), "cycles, sweeps below");
  s.newton = false;  // another coarse solver was asked for, or an obstacle has a functional
  EXPECT_EQ(names(s).front(), "cycles");
  s.newton = true;
  s.coarsest_vectors = 401;
  s.couplings = 100'101;
  EXPECT_EQ(names(s).front(), "cycles, sweeps below");
  s.couplings = 100'100;
  EXPECT_EQ(names(s).front(), "cycles");
}

TEST(Policy, DirectSolversAreForProblemsThatTheyCanTreat) {
  Situation s{.block = 1, .vectors = 12'000, .unknowns = 12'000, .coarsest = 100, .levels = true, .begun = true};
  const auto small = names(s);
  EXPECT_THAT(small, testing::ElementsAre("active sets, multigrid", "active sets, direct", "interior points",
                                          "the coarse solver on the finest level", "more cycles"));
  s.vectors = 50'001;
  s.unknowns = 50'001;
  EXPECT_THAT(names(s), testing::ElementsAre("active sets, multigrid", "active sets, direct", "more cycles"));
  s.unknowns = 150'001;
  EXPECT_THAT(names(s), testing::ElementsAre("active sets, multigrid", "more cycles"));
  s.block = 2;
  EXPECT_THAT(names(s), testing::ElementsAre("more cycles"));
}

TEST(Policy, SparesPartsOfAStepWhatHasFailedOnTheWhole) {
  Situation s{.block = 2, .vectors = 1000, .unknowns = 2000, .coarsest = 100, .levels = true, .begun = true};
  s.functional = s.friction = s.slow = true;
  EXPECT_THAT(names(s), testing::Contains("Newton's method with friction and pressures"));
  s.spent = true;
  EXPECT_THAT(names(s), testing::ElementsAre("cycles from zero", "more cycles"));
}

// None of the linear solvers is there, and nothing has a solution to be found in a step.
TEST(Policy, IsWhatASolveGoesThrough) {
  Model<2> model = resting_block<2>({0, -1e-6}, {});
  model.obstacles.front() = {plane<2>({0, -0.5}, {0, 1}), on("bottom"), "test"};
  model.fixes = {{on("left"), {Field(0), Field(0)}}};
  Mesh<2> mesh = cube<2>(0, 1, 4);
  for (auto& point : mesh.points) point[0] *= 100;
  const auto nested = discretize_all<2, 2>(mesh, 4, model);
  Registry own;
  register_smoothers(own);
  register_transfers(own);
  register_coarse_solvers(own);
  own.add<LinearSolver>({"linear", "cholmod", "", {}, "", {}},
                        [=]() -> std::unique_ptr<LinearSolver> { throw Error(Exit::input, "not there"); });
  SolverOptions options;
  options.max_iterations = 100;
  std::vector<double> x(nested.finest().b.size(), 0.0);
  const Summary s = solve<2>(nested.finest(), nested.prolongations, x, options, own);
  const auto unknowns = static_cast<Offset>(x.size());
  std::vector<std::string> expected = {""}, found = {""};
  for (const Attempt& rule : automatic::stages())
    if (rule.suits(
            {.block = 2, .vectors = nested.finest().A.size(), .unknowns = unknowns, .levels = true, .begun = true}))
      expected.emplace_back(rule.method);
  for (std::size_t k = 1; k < s.stages.size(); ++k) found.push_back(s.stages[k].method);
  EXPECT_EQ(found, std::vector(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(found.size())));
  EXPECT_GE(found.size(), 4u);
}

}  // namespace
}  // namespace signorini::test
