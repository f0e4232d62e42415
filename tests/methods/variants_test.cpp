// All combinations of method, restriction and smoother reach one solution with falling energies; what "auto" chooses.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/solver/cases.hpp"
#include "tests/support/nightly.hpp"
#include "tests/support/pdas.hpp"

namespace signorini::test {
namespace {

using Variant = std::tuple<std::string, std::string, std::string>;  // method, transfer, smoother

class Variants : public testing::TestWithParam<Variant> {};

template <int B>
void expect_solved(const std::vector<Case<B>>& cases, const std::string& name, const SolverOptions& options) {
  const auto found = std::ranges::find(cases, name, &Case<B>::name);
  ASSERT_NE(found, cases.end()) << name;
  const DiscreteProblem<B>& problem = found->nested.finest();
  const Reference exact = reference(problem);
  double last = infinity, scale = problem.prescribed_energy;
  std::vector<double> x;
  const Summary summary = solve_from_zero(found->nested, x, options, [&](const IterationRecord& r) {
    scale = std::max(scale, std::abs(r.energy));
    EXPECT_LE(r.energy, last + 1e-13 * scale) << name << ", cycle " << r.iteration;
    last = r.energy;
    return true;
  });
  EXPECT_TRUE(summary.converged()) << name << ": " << summary.reason;
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-8 * exact.x.norm()) << name;
}

TEST_P(Variants, ReachTheReferenceSolutionWithFallingEnergies) {
  SolverOptions options;
  options.tolerance = 1e-9;
  std::tie(options.method, options.transfer, options.smoother) = GetParam();
  static const auto scalar = scalar_cases();
  static const auto plane = plane_cases();
  static const auto space = space_cases();
  for (const char* name : {"two_sided", "hill", "partly_biactive"}) expect_solved(scalar, name, options);
  for (const char* name : {"incline", "circle", "held"}) expect_solved(plane, name, options);
  expect_solved(space, "held3", options);
}

std::string name_of(const testing::TestParamInfo<Variant>& info) {
  const auto& [method, transfer, smoother] = info.param;
  return method + "_" + transfer + "_" + smoother;
}

INSTANTIATE_TEST_SUITE_P(
    Combined, Variants,
    testing::Combine(testing::Values("auto", "monotone", "tnnmg"), testing::Values("min_merge", "mandel", "kornhuber"),
                     testing::Values("forward", "backward", "symmetric", "adjoint", "surface_first", "patch")),
    name_of);

// And needs as many cycles as one method alone, or one more.
TEST(Automatic, GoesWithoutBoundsWherePhasesRest) {
  const auto cases = scalar_cases();
  std::vector<double> x, y;
  SolverOptions options;
  EXPECT_EQ(options.method, "auto");
  const Summary turns = solve_from_zero(cases.front().nested, x, options);
  EXPECT_EQ(turns.options.method, "monotone and tnnmg in turns");
  for (const char* method : {"tnnmg", "monotone"}) {
    options.method = method;
    const Summary alone = solve_from_zero(cases.front().nested, y, options);
    EXPECT_EQ(alone.options.method, method);
    EXPECT_LE(turns.iterations, alone.iterations + 1) << method;
  }
}

// Without truncation corrections without bounds would be held where contact is.
TEST(Automatic, IsMonotoneMultigridWithoutTruncation) {
  const auto cases = scalar_cases();
  std::vector<double> x, y;
  SolverOptions options;
  options.truncate = "none";
  EXPECT_EQ(solve_from_zero(cases.front().nested, x, options).options.method, "monotone");
  options.method = "monotone";
  solve_from_zero(cases.front().nested, y, options);
  EXPECT_EQ(x, y);
}

/// A unit block of 4 x 4 cells that is held at its left side, drawn out in length.
Nested<2> stretched(Model<2> model, double factor, int refinements) {
  model.fixes = {{on("left"), {Field(0), Field(0)}}};
  Mesh<2> mesh = cube<2>(0, 1, 4);
  for (auto& point : mesh.points) point[0] *= factor;
  return discretize_all<2, 2>(mesh, refinements, model);
}

// Cells of 25 to 1 that bend: neither smoothing nor coarse meshes do much.
TEST(Automatic, TakesToADirectSolverWhereCyclesConvergeTooSlowly) {
  Model<2> model = resting_block<2>({0, -1e-6}, {});
  model.obstacles.front() = {plane<2>({0, -0.5}, {0, 1}), on("bottom"), "test"};
  const auto nested = stretched(model, 100, nightly(4, 3));
  std::vector<double> x;
  const Summary summary = solve_from_zero(nested, x);
  EXPECT_TRUE(summary.converged()) << summary.reason;
  EXPECT_EQ(summary.options.method, "monotone and tnnmg in turns, then pdas");
  ASSERT_EQ(summary.stages.size(), 2u);
  EXPECT_EQ(summary.stages[1].linear, "cholmod");
  EXPECT_GT(summary.stages[1].factorisations, 0);
  const Reference exact = reference(nested.finest());
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-6 * exact.x.norm());
}

// Slow, but done long before a direct solver would be worth it.
TEST(Automatic, KeepsCyclesThatWillEnd) {
  Model<2> model = resting_block<2>({0, -1e-3}, {});
  model.poisson = Field(0.49);
  const auto nested = stretched(model, 4, 3);
  std::vector<double> x;
  const Summary summary = solve_from_zero(nested, x);
  EXPECT_TRUE(summary.converged()) << summary.reason;
  EXPECT_GT(summary.iterations, 60);
  EXPECT_THAT(summary.options.method, testing::Not(testing::HasSubstr("pdas")));
}

}  // namespace
}  // namespace signorini::test
