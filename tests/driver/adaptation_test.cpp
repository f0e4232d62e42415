#include "driver/levels/adaptation.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/scenes/tables.hpp"
#include "core/mesh/refine.hpp"
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

/// What a run solves on.
template <int D>
struct Solved {
  Solved(const Adaptation<D>& adaptation, int order)
      : meshes(hierarchy(adaptation.mesh(), order - 1)), nodes(meshes.finest(), order) {}
  SolvedOn<D> on() const { return {meshes, nodes}; }

  MeshHierarchy<D> meshes;
  Nodes<D> nodes;
};

TEST(Adaptation, CutsWhereTheErrorIs) {
  Adaptation<2> adaptation(rectangle({0, 0}, {1, 1}, {4, 4}), 0);
  std::vector<double> share(32, 1e-6);
  share[0] = 1;
  const Solved<2> solved(adaptation, 1);
  adaptation.refine(solved.on(), share, 1.5);
  double left = 0, right = 0;
  for (const auto& element : adaptation.mesh().elements)
    (adaptation.mesh().points[element[0]][0] < 0.5 ? left : right) += 1;
  EXPECT_GT(left, 1.5 * right);
  EXPECT_LE(adaptation.mesh().elements.size(), 80u);
}

/// A function of the elements' degree stays what it is.
template <int D>
void expect_carried_over(Mesh<D> coarsest, int order) {
  Adaptation<D> adaptation(std::move(coarsest), 1, order);
  const auto values = [&](const Mesh<D>& mesh) {
    std::vector<double> out;
    for (const auto& x : mesh.points) {
      const double bent = order == 1 ? 0 : x[0] * x[1] - x[D - 1] * x[D - 1];
      out.insert(out.end(), {1 + x[0] - 2 * x[1] + bent, x[D - 1]});
    }
    return out;
  };
  auto solved = std::make_unique<Solved<D>>(adaptation, order);
  for (int k = 0; k < 3; ++k) {
    std::vector<double> share(adaptation.mesh().elements.size(), 1e-3);
    share[3] = 1;
    const std::vector<double> u = solved->nodes.at_nodes(values(solved->meshes.finest()), 2);
    adaptation.refine(solved->on(), share, 2);
    auto next = std::make_unique<Solved<D>>(adaptation, order);
    const std::vector<double> found = adaptation.carried_over(solved->on(), u, next->on(), 2);
    const std::vector<double> expected = values(next->meshes.finest());
    ASSERT_THAT(found, SizeIs(expected.size()));
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-13);
    solved = std::move(next);
  }
}

TEST(Adaptation, CarriesFunctionsOfTheElementsOverExactly) {
  for (const int order : {1, 2}) {
    expect_carried_over(rectangle({0, 0}, {1, 1}, {2, 3}), order);
    expect_carried_over(box({0, 0, 0}, {1, 1, 1}, {1, 1, 1}), order);
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
  const double rate = std::log(first.error.upper / last.error.upper) / std::log(1.0 * last.unknowns / first.unknowns);
  EXPECT_GT(rate, 0.9);
  // The true error is that against a much finer mesh, and lies within the bounds of all.
  Driver fine(scene_of(corner, {"refine.adaptive=true", "refine.tolerance=2e-4"}));
  const double best = fine.solve().adaptive->steps.back().energy;
  const double off = fine.report().adaptive->steps.back().error.upper;
  for (const AdaptiveStep& mesh : meshes) {
    EXPECT_LE(mesh.error.lower, mesh.energy - best + off);
    EXPECT_GE(mesh.error.upper, mesh.energy - best);
    EXPECT_TRUE(mesh.error.guaranteed);
  }
  // Starts are solutions of the mesh before.
  for (std::size_t k = 2; k < meshes.size(); ++k) EXPECT_LE(meshes[k].iterations, 12);
}

double rate(const AdaptiveStep& coarse, const AdaptiveStep& fine, double energy) {
  return std::log((coarse.energy - energy) / (fine.energy - energy)) / std::log(1.0 * fine.unknowns / coarse.unknowns);
}

/// Quadratic elements: N^(-2) of the energy in the plane, where uniform meshes get N^(-2/3); bounds hold there, too.
TEST(Adaptive, QuadraticElementsGetTheirRateAtACorner) {
  const auto meshes = [](const std::vector<std::string>& more) {
    std::vector<std::string> all{"refine.adaptive=true", "body.0.order=2"};
    all.insert(all.end(), more.begin(), more.end());
    return Driver(scene_of(corner, all)).solve().adaptive->steps;
  };
  const double best = meshes({"refine.tolerance=1e-6", "solver.estimate=recovery"}).back().energy;
  for (const char* estimate : {"true", "recovery"}) {
    const auto found = meshes({"refine.tolerance=1e-3", std::string("solver.estimate=") + estimate});
    ASSERT_GE(found.size(), 5u) << estimate;
    EXPECT_GT(rate(found[1], found.back(), best), 1.5) << estimate;
    for (const AdaptiveStep& mesh : found) EXPECT_EQ(mesh.error.guaranteed, estimate == std::string("true"));
    for (std::size_t k = 2; k < found.size(); ++k) EXPECT_LE(found[k].iterations, 12);
  }
}

/// Half a disk on a block, where there are no bounds: both are refined where they touch.
const std::string hertz = R"(
[[body]]
name = "disk"
shape = "half_disk"
center = [0, 1]
radius = 1
size = 0.35
young = 1
poisson = 0.3
[[body]]
name = "block"
shape = "rectangle"
from = [-1.5, -1.5]
to = [1.5, 0]
cells = [9, 5]
young = 1
poisson = 0.3
[[fix]]
body = "disk"
on = "flat"
value = [0, -0.02]
[[fix]]
body = "block"
on = "bottom"
value = [0, 0]
[[obstacle]]
type = "elastic"
body = "disk"
on = "curved"
other = "block"
other_on = "top"
)";

TEST(Adaptive, TwoBodiesAreRefinedWhereTheyTouch) {
  const auto solve = [](int order, std::vector<std::string> more) {
    for (int body = 0; body < 2; ++body) more.push_back(fmt::format("body.{}.order={}", body, order));
    return Driver(scene_of(hertz, more)).solve();
  };
  const auto force = [](const Report& of) { return of.last().contact[0].force[1]; };
  const double exact = 0.0055775067;  // on a uniform mesh of quadratic elements with 2 049 664 unknowns
  for (const int order : {1, 2}) {
    const Report uniform = solve(order, {fmt::format("refine.uniform={}", order == 1 ? 4 : 3)});
    const int quarter = uniform.last().summary.level_unknowns.back() / 4;
    const Report adaptive =
        solve(order, {"refine.adaptive=true", "refine.tolerance=1e-9", fmt::format("refine.max_unknowns={}", quarter)});
    ASSERT_TRUE(adaptive.converged());
    EXPECT_FALSE(adaptive.last().estimate->guaranteed);
    EXPECT_THAT(adaptive.last().estimate->reasons, testing::Contains("an estimate, no bound"));
    EXPECT_LT(std::abs(force(adaptive) - exact), std::abs(force(uniform) - exact)) << "order " << order;
  }
}

TEST(Adaptive, BodiesOfRevolutionAreRefinedByAnEstimate) {
  const std::string ball = R"(
[[body]]
name = "ball"
shape = "half_disk"
center = [0, 0]
radius = 1
size = 0.3
plane = "axisymmetric"
young = 1
poisson = 0.3
[[fix]]
body = "ball"
on = "flat"
value = [0, -0.02]
[[obstacle]]
type = "contact"
body = "ball"
on = "curved"
shape = "plane"
point = [0, -1]
normal = [0, 1]
)";
  for (const char* order : {"body.0.order=1", "body.0.order=2"}) {
    Driver driver(scene_of(ball, {"refine.adaptive=true", "refine.tolerance=0.02", order}));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged() && report.adaptive->reached) << report.adaptive->reason;
    EXPECT_GE(report.adaptive->steps.size(), 2u);
    EXPECT_THAT(report.last().estimate->reasons, testing::Contains("bodies of revolution are not covered"));
  }
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
  const std::string apart = corner + "[[body]]\nname = \"other\"\nshape = \"rectangle\"\nfrom = [3, 0]\nto = [4, 1]\n" +
                            "cells = [2, 2]\nequation = \"diffusion\"\n" + tables::fix("other", "boundary", "[1]");
  EXPECT_THAT(error_of(scene_of(apart, adaptive)),
              testing::AllOf(HasSubstr("refine.adaptive"), HasSubstr("2 bodies that nothing lets touch")));
}

}  // namespace
}  // namespace signorini::test
