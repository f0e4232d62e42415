#include "driver/levels/adaptation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/scenes/tables.hpp"
#include "core/mesh/structured.hpp"
#include "driver/driver.hpp"

namespace signorini::test {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::SizeIs;

const std::string corner = R"(
[[body]]
name = "membrane"
shape = "polygon"
points = [[0, 0], [1, 0], [1, 1], [-1, 1], [-1, -1], [0, -1]]
size = 0.6
equation = "diffusion"
[[fix]]
body = "membrane"
on = "boundary"
value = [0]
[[load]]
body = "membrane"
value = [-1]
[[obstacle]]
type = "scalar"
body = "membrane"
lower = "-0.05"
)";

Scene scene_of(const std::string& text, const std::vector<std::string>& overrides) {
  return parse_scene(text, "test.toml", ".", overrides);
}

std::string error_of(const Scene& scene) {
  try {
    Driver(scene).solve();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return {};
}

TEST(Adaptation, CutsWhereTheErrorIs) {
  Adaptation<2> adaptation(rectangle({0, 0}, {1, 1}, {4, 4}), 0);
  std::vector<double> share(32, 1e-6);
  share[0] = 1;
  adaptation.refine(share, 1.5);
  double left = 0, right = 0;
  for (const auto& element : adaptation.mesh().elements)
    (adaptation.mesh().points[element[0]][0] < 0.5 ? left : right) += 1;
  EXPECT_GT(left, 1.5 * right);
  EXPECT_LE(adaptation.mesh().elements.size(), 80u);
}

TEST(Adaptation, CarriesLinearFunctionsOverExactly) {
  Adaptation<3> adaptation(box({0, 0, 0}, {1, 1, 1}, {1, 1, 1}), 1);
  const auto values = [&] {
    std::vector<double> out;
    for (const auto& x : adaptation.mesh().points) out.insert(out.end(), {1 + x[0] - 2 * x[1], x[2]});
    return out;
  };
  std::vector<double> u = values(), share(adaptation.mesh().elements.size(), 1e-3);
  for (int k = 0; k < 3; ++k) {
    share.assign(adaptation.mesh().elements.size(), 1e-3);
    share[3] = 1;
    adaptation.refine(share, 2);
    u = adaptation.carried_over(u, 2);
    const std::vector<double> expected = values();
    ASSERT_THAT(u, SizeIs(expected.size()));
    for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], expected[i], 1e-14);
  }
}

// In the corner the membrane has a singularity: uniform meshes get N^(-2/3) of the energy, these N^(-1).
TEST(Adaptive, MeshesGetTheBestRateAtACorner) {
  Driver driver(scene_of(corner, {"refine.adaptive=true", "refine.tolerance=0.004"}));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged());
  ASSERT_TRUE(report.adaptive && report.adaptive->reached) << report.adaptive->reason;
  const auto& meshes = report.adaptive->steps;
  ASSERT_GE(meshes.size(), 4u);
  const AdaptiveStep &first = meshes[1], &last = meshes.back();
  const double rate = std::log(first.upper / last.upper) / std::log(1.0 * last.unknowns / first.unknowns);
  EXPECT_GT(rate, 0.9);
  // The true error is that against a much finer mesh, and lies within the bounds of all.
  Driver fine(scene_of(corner, {"refine.adaptive=true", "refine.tolerance=2e-4"}));
  const double best = fine.solve().adaptive->steps.back().energy;
  const double off = fine.report().adaptive->steps.back().upper;
  for (const AdaptiveStep& mesh : meshes) {
    EXPECT_LE(mesh.lower, mesh.energy - best + off);
    EXPECT_GE(mesh.upper, mesh.energy - best);
    EXPECT_TRUE(mesh.guaranteed);
  }
  // Starts are solutions of the mesh before.
  for (std::size_t k = 2; k < meshes.size(); ++k) EXPECT_LE(meshes[k].iterations, 12);
}

TEST(Adaptive, RunsEndWithinTheirLimitsAndSayWhy) {
  Driver few(scene_of(corner, {"refine.adaptive=true", "refine.tolerance=1e-6", "refine.max_unknowns=500"}));
  const Report& report = few.solve();
  EXPECT_TRUE(report.converged());
  EXPECT_FALSE(report.adaptive->reached);
  EXPECT_THAT(report.adaptive->reason, HasSubstr("refine.max_unknowns is 500"));
  EXPECT_LE(report.adaptive->steps.back().unknowns, 500);
  EXPECT_EQ(std::ranges::count(report.warnings, "accuracy-not-reached", &Warning::id), 1);

  Driver two(scene_of(corner, {"refine.adaptive=true", "refine.tolerance=1e-6", "refine.max_steps=2"}));
  EXPECT_THAT(two.solve().adaptive->steps, SizeIs(3));
  EXPECT_THAT(two.report().adaptive->reason, HasSubstr("refine.max_steps is 2"));
}

TEST(Adaptive, RunsThatCannotBeAreRefusedWithTheReason) {
  const std::vector<std::string> adaptive{"refine.adaptive=true"};
  EXPECT_THAT(error_of(scene_of(corner + "[steps]\ncount = 2\n", adaptive)),
              testing::AllOf(HasSubstr("refine.adaptive"), HasSubstr("2 steps, expected one")));
  EXPECT_THAT(error_of(scene_of(corner, {"refine.adaptive=true", "body.0.order=2"})),
              testing::AllOf(HasSubstr("refine.adaptive"), HasSubstr("quadratic")));
}

}  // namespace
}  // namespace signorini::test
