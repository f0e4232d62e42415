// Any coefficient of friction, small or large: what is called solved obeys Coulomb's law, as a judge says that knows
// the displacements alone; what is not is said to be.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "apps/bench/friction/friction_law.hpp"
#include "apps/bench/friction/friction_scenes.hpp"
#include "driver/driver.hpp"

namespace signorini::test {
namespace {

using bench::FrictionScene;
using bench::LawViolation;
using bench::RoughPlane;
using bench::Traction;

constexpr double across = 0.93969262, along = 0.34202014;  // of the normals of the wedge's sides

std::vector<RoughPlane<2>> sides(double friction) {
  const double length = std::hypot(across, along), c = across / length, s = along / length;
  return {{"edge1", {0.3, 0}, {-c, s}, friction}, {"edge3", {-0.3, 0}, {c, s}, friction}};
}

template <int D>
LawViolation judge(const Driver& driver, const std::vector<RoughPlane<D>>& planes,
                   const std::vector<Traction<D>>& loads, const std::vector<std::string>& fixed,
                   const std::vector<double>& u, const std::vector<double>& last) {
  LawViolation out;
  driver.visit(0, [&](const auto& body) {
    if constexpr (std::is_same_v<std::decay_t<decltype(body)>, BodyRun<D, D>>)
      out = bench::law_violation<D>(body.mesh(), 1, 0.3, planes, loads, fixed, u, last);
  });
  return out;
}

/// A block whose top is moved: solved as the law says, or not and said.
template <int D>
bool obeys_or_says(const FrictionScene& scene, double friction, const Point<D>& normal) {
  Driver driver(scene.with(friction));
  const Summary& summary = driver.solve().last().summary;
  EXPECT_LE(summary.iterations, 200);
  if (!summary.converged()) {
    EXPECT_NE(summary.reason, "");
    return false;
  }
  const std::vector<double> u = driver.solution();
  const LawViolation law =
      judge<D>(driver, {{"bottom", {}, normal, friction}}, {}, {"top"}, u, std::vector<double>(u.size(), 0.0));
  EXPECT_LE(law.worst(), 1e-6) << scene.name << ", friction " << friction;
  EXPECT_EQ(law.sticking, driver.report().last().contact[0].stick_nodes) << scene.name << ", friction " << friction;
  return true;
}

TEST(Coefficients, WhatIsSolvedObeysTheLaw) {
  const FrictionScene pressed2 = bench::block_2d("pressed", "[0.03, -0.03]", 3),
                      pushed2 = bench::block_2d("pushed", "[0.1, -0.01]", 3),
                      pressed3 = bench::block_3d("pressed", "[0.03, 0.015, -0.03]", 1),
                      pushed3 = bench::block_3d("pushed", "[0.1, 0.05, -0.01]", 1);
  for (const double friction : {0.05, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0}) {
    EXPECT_TRUE(obeys_or_says<2>(pressed2, friction, {0, 1})) << friction;
    EXPECT_TRUE(obeys_or_says<2>(pushed2, friction, {0, 1}) || friction > 2) << friction;
    EXPECT_TRUE(obeys_or_says<3>(pressed3, friction, {0, 0, 1})) << friction;
    EXPECT_TRUE(obeys_or_says<3>(pushed3, friction, {0, 0, 1}) || friction > 2) << friction;
  }
}

// Else it would tell nothing: another coefficient, one vertex that moves a little, one that was not where it is said.
TEST(Coefficients, TheJudgeSeesWhatIsWrong) {
  Driver driver(bench::block_2d("pressed", "[0.03, -0.03]", 3).with(0.3, {"solver.tolerance=1e-11"}));
  driver.solve();
  std::vector<double> u = driver.solution(), none(u.size(), 0.0);
  const std::vector<double> points = driver.points();
  const auto worst = [&](double friction) {
    return judge<2>(driver, {{"bottom", {}, {0, 1}, friction}}, {}, {"top"}, u, none).worst();
  };
  EXPECT_LE(worst(0.3), 1e-8);
  EXPECT_NEAR(worst(0.31), 0.01 / std::hypot(1, 0.3), 1e-4);  // of the largest force, normal and tangential
  EXPECT_GE(judge<2>(driver, {{"bottom", {0, -1e-4}, {0, 1}, 0.3}}, {}, {"top"}, u, none).worst(), 0.1);
  EXPECT_GE(judge<2>(driver, {{"bottom", {0, 1e-4}, {0, 1}, 0.3}}, {}, {"top"}, u, none).penetration, 1e-3);
  std::size_t middle = 0;
  while (!(std::abs(points[middle] - 1) < 0.3 && points[middle + 1] == 0)) middle += 2;
  none[middle] = u[middle] + 1e-4;
  EXPECT_GE(worst(0.3), 1e-2);
  none[middle] = 0;
  u[middle] += 1e-5;
  EXPECT_GE(worst(0.3), 1e-4);
}

// Sides that slip as a whole divide the load exactly: P / 2 = N (sin + mu cos) on the way in, Q / 2 = N (sin - mu cos)
// on the way out. Near mu = tan 20 the bound swings: the force that it takes away from a side is nearly as large.
TEST(Coefficients, AWedgeSlipsOutBelowTheAngleOfFrictionAndLocksAbove) {
  const double length = std::hypot(across, along), c = across / length, s = along / length;
  const double load = 0.02 * (0.3 + along / across);
  const std::vector<double> parts{1, 0.82, 0.55, 0.28, 0.1};
  for (const double friction : {0.0, 0.1, 0.3, 0.35, 0.37, 0.5, 1.0, 5.0}) {
    SCOPED_TRACE(friction);
    Driver driver(bench::wedge(1).with(friction));
    std::vector<double> last;
    driver.solve([&] {
      const StepReport& step = driver.report().last();
      const std::size_t k = driver.report().steps.size() - 1;
      EXPECT_TRUE(step.summary.converged()) << step.summary.reason;
      EXPECT_LE(step.summary.iterations, 80);
      const std::vector<double> u = driver.solution();
      if (last.empty()) last.assign(u.size(), 0.0);
      EXPECT_LE(judge<2>(driver, sides(friction), {{"edge2", {0, -0.01 * parts[k]}}}, {}, u, last).worst(), 1e-5) << k;
      last = u;
      const ContactReport& side = step.contact[0];
      const double normal = std::hypot(side.normal_force[0], side.normal_force[1]);
      if (k == 0 && friction < 0.4) {
        EXPECT_NEAR(normal, load / (2 * (s + friction * c)), 1e-6 * load);
      }
      if (k + 1 == parts.size() && friction < 0.15) {
        EXPECT_NEAR(normal, 0.1 * load / (2 * (s - friction * c)), 1e-6 * load);
      }
    });
    EXPECT_EQ(driver.report().steps.size(), parts.size());
    if (friction >= 0.37) {
      EXPECT_GT(driver.report().last().contact[0].stick_nodes, 0);
    }
  }
}

// What locks stays pressed when the load is taken off altogether, though all that lets go would be in balance, too.
TEST(Coefficients, AWedgeThatLocksStaysPressedWithoutALoad) {
  const auto pressed = [](const char* left) {
    Driver driver(bench::wedge(1).with(
        0.5, {fmt::format("load.0.value=[0, \"-0.01 * (t < 0.5 ? 2 * t : 1 - (1 - {}) * (2 * t - 1))\"]", left)}));
    const StepReport& step = driver.solve().last();
    EXPECT_TRUE(step.summary.converged()) << step.summary.reason;
    EXPECT_LE(step.summary.iterations, 40) << left;
    return std::hypot(step.contact[0].normal_force[0], step.contact[0].normal_force[1]);
  };
  const double without = pressed("0"), with = pressed("1e-5");
  EXPECT_GT(without, 0.001);
  EXPECT_NEAR(without, with, 1e-3 * with);
}

TEST(Coefficients, BoundsThatSwingSettleInAFewCycles) {
  for (const double friction : {0.3, 0.35, 0.36}) {
    Driver driver(bench::wedge(2).with(friction));
    for (const StepReport& step : driver.solve().steps) EXPECT_LE(step.summary.iterations, 40) << friction;
  }
}

TEST(Coefficients, ContactLoadsNoLibraryOfFriction) {
  FrictionScene scene = bench::block_2d("block", "[0.03, -0.03]", 1);
  Scene contact = scene.with(0);
  contact.obstacles[0].type = "contact";
  std::erase_if(contact.obstacles[0].options.entries, [](const auto& entry) { return entry.first == "friction"; });
  Driver with(scene.with(0)), without(contact);
  with.solve();
  without.solve();
  EXPECT_EQ(with.solution(), without.solution());
  ASSERT_EQ(without.report().plugins.size(), 1U);
  EXPECT_EQ(without.report().plugins[0].id, "contact");
  with.visit(0, [](const auto& body) {
    for (const auto& node : body.results().contact.nodes) EXPECT_FALSE(node.friction);
  });
}

// Starts from coarser meshes count, though their residuals are larger than that of zero.
TEST(Wedge, UnloadingBeginsAtTheLastStep) {
  Driver driver(bench::wedge(3).with(0.3));
  for (const StepReport& step : driver.solve().steps) {
    ASSERT_TRUE(step.summary.converged()) << step.summary.reason;
    EXPECT_LE(step.summary.iterations, 16) << "t = " << step.t;
  }
}

}  // namespace
}  // namespace signorini::test
