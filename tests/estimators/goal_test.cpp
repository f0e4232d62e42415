// Runs that are refined for a number: what they say its error is, against the number on much finer meshes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "apps/scenes/tables.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"
#include "driver/reports/goals.hpp"

namespace signorini::test {
namespace {

using testing::HasSubstr;

const std::string plane_strain = "young = 1\npoisson = 0.3\nplane = 'strain'\n";

std::string pressed_half_disk(const std::string& material) {
  return "[[body]]\nname = 'b'\nshape = 'half_disk'\ncenter = [0, 0]\nradius = 1\nsize = 0.25\n" + material +
         tables::fix("b", "flat", "[0, -0.02]") + tables::plane("b", "curved", "[0, -1]", "[0, 1]") +
         tables::probe("inside", "b", "[0.3, -0.6]");
}

std::string round_cylinder() { return pressed_half_disk(plane_strain); }
std::string round_ball() { return pressed_half_disk("young = 1\npoisson = 0.3\nplane = 'axisymmetric'\n"); }

std::string block_on_cylinder() {
  return tables::block("b", "[-1, 0]", "[1, 1]", "[8, 4]", plane_strain) + "[symmetry]\nx = 0\n" +
         tables::fix("b", "top", "['free', -0.02]") + tables::probe("inside", "b", "[0.3, 0.4]") +
         "[[obstacle]]\ntype = 'contact'\nbody = 'b'\non = 'bottom'\nshape = 'sphere'\ncenter = [0, -4]\nradius = 4\n";
}

/// u = (r^2 - 1) / 2 - log r outside of the unit circle, and in contact within it.
std::string radial_membrane() {
  return tables::block("b", "[-1.5, -1.5]", "[1.5, 1.5]", "[6, 6]", "equation = 'diffusion'\n") +
         tables::fix("b", "boundary", "'(x^2 + y^2 - 1) / 2 - log(x^2 + y^2) / 2'") + tables::load("b", "-2") +
         tables::floor("b", "0") + tables::probe("inside", "b", "[1.2, 0.4]");
}

Report adaptive_run(const std::string& scene, const std::vector<std::string>& overrides) {
  std::vector<std::string> all{"solver.tolerance=1e-10"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return Driver(parse_scene(scene, "test.toml", ".", all)).solve();
}

double length_of(const std::vector<double>& v) {
  return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
}

double value_of_goal(const std::string& goal, const StepReport& of) {
  if (goal == "force") return length_of(of.contact[0].normal_force);
  return goal == "peak_pressure" ? of.contact[0].max_pressure : length_of(of.probes[0].value);
}

struct GoalCase {
  const char* name;
  std::string (*scene)();
  const char* goal;
  int order, unknowns;
};

Report refined_for(const GoalCase& of, int unknowns, int order) {
  return adaptive_run(of.scene(),
                      {"refine.adaptive=true", "refine.tolerance=1e-12", "refine.goal=" + std::string(of.goal),
                       "refine.max_unknowns=" + std::to_string(unknowns), "body.0.order=" + std::to_string(order)});
}

class Goals : public testing::TestWithParam<GoalCase> {};

/// Signs of errors change from mesh to mesh: where one happens to be near zero any estimate is far off. So in the mean
/// over the meshes that have found the contact, and of each mesh at least that little is claimed only where little is.
TEST_P(Goals, AreAboutAsFarOffAsIsSaid) {
  const GoalCase& of = GetParam();
  const double exact = refined_for(of, 8 * of.unknowns, 2).adaptive->steps.back().error.goal->value;
  const Report found = refined_for(of, of.unknowns, of.order);
  EXPECT_DOUBLE_EQ(found.last().estimate->goal->value, value_of_goal(of.goal, found.last()));
  double logarithms = 0;
  int count = 0;
  for (const AdaptiveStep& mesh : found.adaptive->steps) {
    const GoalReport& goal = *mesh.error.goal;
    EXPECT_EQ(goal.name, of.goal);
    const double effectivity = goal.error / std::abs(goal.value - exact);
    std::printf("%s, %s, order %d, %d unknowns: off by %.1e, effectivity %.2f\n", of.name, of.goal, of.order,
                mesh.unknowns, std::abs(goal.value - exact) / exact, effectivity);
    if (mesh.unknowns < of.unknowns / 8) continue;
    logarithms += std::log(effectivity);
    ++count;
  }
  ASSERT_GE(count, 2);
  const double mean = std::exp(logarithms / count);
  std::printf("in the mean %.2f\n", mean);
  // The ball's force passes the exact one at 3000 unknowns: the estimate does not, and is too large by 2.4 in the mean.
  const bool passes = of.name == std::string("Ball") && of.goal == std::string("force");
  const double factor = of.goal == std::string("peak_pressure") ? 4 : passes ? 3 : 2;
  EXPECT_GT(mean, 1 / factor);
  EXPECT_LT(mean, factor);
}

INSTANTIATE_TEST_SUITE_P(Estimated, Goals,
                         testing::Values(GoalCase{"Cylinder", round_cylinder, "force", 2, 8000},
                                         GoalCase{"Cylinder", round_cylinder, "peak_pressure", 2, 8000},
                                         GoalCase{"Cylinder", round_cylinder, "probe inside", 2, 8000},
                                         GoalCase{"Cylinder", round_cylinder, "force", 1, 8000},
                                         GoalCase{"Block", block_on_cylinder, "force", 2, 8000},
                                         GoalCase{"Block", block_on_cylinder, "peak_pressure", 2, 8000},
                                         GoalCase{"Block", block_on_cylinder, "probe inside", 2, 8000},
                                         GoalCase{"Ball", round_ball, "force", 2, 8000},
                                         GoalCase{"Ball", round_ball, "peak_pressure", 2, 8000},
                                         GoalCase{"Membrane", radial_membrane, "force", 1, 8000},
                                         GoalCase{"Membrane", radial_membrane, "probe inside", 1, 8000}),
                         [](const auto& param) {
                           const std::string goal = param.param.goal;
                           return param.param.name +
                                  std::string(goal == "force"           ? "Force"
                                              : goal == "peak_pressure" ? "Peak"
                                                                        : "Probe") +
                                  std::to_string(param.param.order);
                         });

/// A third of the error, with a quarter of the unknowns.
TEST(Goal, IsNearerThanOnUniformMeshes) {
  const GoalCase of{"Cylinder", round_cylinder, "force", 2, 8000};
  const double exact = refined_for(of, 64000, 2).adaptive->steps.back().error.goal->value;
  const Report uniform = adaptive_run(round_cylinder(), {"refine.uniform=4"});
  const Report found = refined_for(of, uniform.last().summary.level_unknowns.back() / 4, 2);
  EXPECT_LT(std::abs(found.last().estimate->goal->value - exact),
            std::abs(value_of_goal("force", uniform.last()) - exact) / 3);
}

TEST(Goal, EndsARunAtItsTolerance) {
  const Report found = adaptive_run(
      round_cylinder(), {"refine.adaptive=true", "refine.goal=force", "refine.tolerance=1e-3", "solver.estimate=true"});
  EXPECT_TRUE(found.adaptive->reached) << found.adaptive->reason;
  EXPECT_LE(found.last().estimate->goal->relative_error(), 1e-3);
  const auto& meshes = found.adaptive->steps;
  ASSERT_GE(meshes.size(), 2u);
  EXPECT_GT(meshes[meshes.size() - 2].error.goal->relative_error(), 1e-3);

  const Report few = adaptive_run(round_cylinder(), {"refine.adaptive=true", "refine.goal=force",
                                                     "refine.tolerance=1e-6", "refine.max_unknowns=500"});
  EXPECT_FALSE(few.adaptive->reached);
  EXPECT_EQ(std::ranges::count(few.warnings, "accuracy-not-reached", &Warning::id), 1);
}

std::string refusal_of(const std::string& scene, const std::vector<std::string>& overrides) {
  std::vector<std::string> all{"refine.adaptive=true", "refine.goal=force"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  try {
    adaptive_run(scene, all);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return {};
}

TEST(Goal, IsRefusedWhereItIsNotCovered) {
  EXPECT_THAT(refusal_of(round_cylinder(), {"body.0.poisson=0.49"}),
              testing::AllOf(HasSubstr("refine.goal"), HasSubstr("body 'b' is nearly incompressible"),
                             HasSubstr("expected \"energy\"")));
  EXPECT_EQ(refusal_of(round_cylinder(), {"body.0.poisson=0.49", "body.0.pressure=none", "refine.max_steps=1"}), "");
}

}  // namespace
}  // namespace signorini::test
