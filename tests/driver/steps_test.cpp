// Quasi-static steps: parts of steps that fail, what is kept, and what the report says of obstacles.
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "apps/scenes/tables.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"

namespace signorini::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string friction_plane(tables::Text bound, tables::Text point, tables::Text normal) {
  return fmt::format(
      "[[obstacle]]\ntype = \"tresca\"\nbound = {}\nbody = \"block\"\non = \"bottom\"\nshape = \"plane\"\npoint = {}\n"
      "normal = {}\n",
      bound, point, normal);
}

Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "test.toml", ".", overrides);
}

/// Pressed on a plane and pushed along it.
const std::string pushed = tables::block("block", "[0, 0]", "[2, 1]", "[8, 4]") +
                           tables::fix("block", "top", "['0.02 * t', -0.03]") +
                           friction_plane("0.01", "[0, 0]", "[0, 1]") + "[refine]\nuniform = 2\n";

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = a.size() == b.size() ? 0 : NAN;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

std::vector<double> times(const Report& report) {
  std::vector<double> t;
  for (const StepReport& step : report.steps) t.push_back(step.t);
  return t;
}

/// The state after a step, and the report of all.
struct Solved {
  Report report;
  std::vector<std::vector<double>> solutions;
};

Solved solved(const Scene& scene, const std::vector<double>& start = {}) {
  Driver driver(scene);
  if (!start.empty()) driver.start_from(0, start);
  Solved out;
  driver.solve([&] { out.solutions.push_back(driver.solution()); });
  out.report = driver.report();
  return out;
}

/// By sweeps alone, which take the more of them the farther a step goes.
std::vector<std::string> swept(int limit, const std::string& steps, int halvings = 4) {
  return {"solver.method=pgs", "solver.tolerance=1e-7", fmt::format("solver.max_iterations={}", limit),
          fmt::format("steps.halvings={}", halvings), "steps.at=" + steps};
}

const Solved& reference() {
  static const Solved whole = solved(scene_of(pushed, swept(2000, "[0.5, 1]")));
  return whole;
}

// The limit is too low for the second step, and high enough for its parts.
TEST(StepsInParts, AreThoseThatWouldHaveBeenGiven) {
  ASSERT_TRUE(reference().report.converged()) << reference().report.reason();
  const int needed = reference().report.steps[1].summary.iterations, limit = 7 * needed / 8;
  const Solved cut = solved(scene_of(pushed, swept(limit, "[0.5, 1]")));
  ASSERT_TRUE(cut.report.converged()) << cut.report.reason();
  ASSERT_GE(cut.report.failed.size(), 1u) << needed;
  EXPECT_EQ(cut.report.failed[0].step, 2);
  EXPECT_EQ(cut.report.failed[0].from, 0.5);
  EXPECT_EQ(cut.report.failed[0].t, 1);
  EXPECT_EQ(cut.report.failed[0].iterations, limit);
  EXPECT_THAT(cut.report.warnings, testing::Contains(HasSubstr("step 2: from t = 0.5 to 1 no solution was found")));
  double from = 0;
  for (const StepReport& step : cut.report.steps) {
    EXPECT_EQ(step.from, from);
    EXPECT_EQ(step.step, from < 0.5 ? 1 : 2);
    EXPECT_EQ(step.halvings, from < 0.5 ? 0 : std::lround(std::log2(0.5 / (step.t - from))));
    from = step.t;
  }
  EXPECT_EQ(from, 1);
  const Solved listed = solved(scene_of(pushed, swept(limit, fmt::format("[{}]", fmt::join(times(cut.report), ",")))));
  ASSERT_TRUE(listed.report.failed.empty());
  ASSERT_EQ(cut.solutions.size(), listed.solutions.size());
  for (std::size_t k = 0; k < cut.solutions.size(); ++k)
    EXPECT_EQ(largest_difference(cut.solutions[k], listed.solutions[k]), 0) << "what failed left traces in part " << k;
  EXPECT_EQ(cut.report.last().contact[0].dissipated, listed.report.last().contact[0].dissipated);
  const double sizes = 0.03;
  EXPECT_LE(largest_difference(cut.solutions.back(), reference().solutions.back()), 1e-2 * sizes);
}

TEST(StepsInParts, StepsBeforeAreKeptAndTheNextSolveStartsFromThem) {
  const int needed = reference().report.steps[1].summary.iterations;
  Driver driver(scene_of(pushed, swept(needed / 2, "[0.5, 1]", 1)));
  driver.start_from(0, reference().solutions[0]);
  driver.solve();
  const Report failed = driver.report();
  ASSERT_EQ(failed.steps.size(), 2u);
  EXPECT_TRUE(failed.steps[0].summary.converged());
  EXPECT_FALSE(failed.steps[1].summary.converged());
  EXPECT_FALSE(failed.converged());
  EXPECT_EQ(failed.last().t, 0.75);
  EXPECT_THAT(failed.reason(), HasSubstr("the part from t = 0.5 to 0.75 of a step that was cut in two 1 times"));
  EXPECT_EQ(failed.failed.size(), 1u);
  // The first step again: at its solution already.
  driver.scene().steps.at = {0.5};
  driver.solve();
  EXPECT_TRUE(driver.report().converged()) << driver.report().reason();
  EXPECT_LE(driver.report().last().summary.iterations, failed.steps[0].summary.iterations);
}

TEST(StepsInParts, NoneWhereTheyAreSwitchedOff) {
  const Solved failed = solved(scene_of(pushed, swept(3, "[0.5, 1]", 0)), reference().solutions[0]);
  EXPECT_TRUE(failed.report.failed.empty());
  EXPECT_EQ(failed.report.steps.size(), 2u);
  EXPECT_FALSE(failed.report.converged());
  EXPECT_THAT(failed.report.warnings, testing::Not(testing::Contains(HasSubstr("step 2"))));
}

// Uniform pressure p and shear g: forces in the middle of the face, about a corner of its quarter.
TEST(ObstacleForces, MomentsAreThoseOfTheMiddle) {
  const double p = 0.03, g = 0.004, gx = 2 * g / std::sqrt(5), gy = g / std::sqrt(5);
  const auto side = [](const char* on, double shear) {
    return tables::load("block", fmt::format("[0, 0, {}]", shear), on);
  };
  const std::string scene =
      tables::block("block", "[0, 0, 0]", "[2, 1, 1]", "[4, 2, 2]", "order = 1\nyoung = 1\npoisson = 0\n") +
      tables::fix("block", "top", fmt::format("[0.02, 0.01, {}]", -p)) + side("right", gx) + side("left", -gx) +
      side("back", gy) + side("front", -gy) + friction_plane(fmt::format("{}", g), "[0.5, 0.25, 0]", "[0, 0, 1]") +
      "[solver]\ntolerance = 1e-11\n";
  Driver driver(scene_of(scene));
  driver.solve();
  const ContactReport& contact = driver.report().last().contact[0];
  const double F[3] = {-2 * gx, -2 * gy, 2 * p}, lever[3] = {0.5, 0.25, 0};
  EXPECT_THAT(contact.moment_about, ElementsAre(0.5, 0.25, 0));
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    EXPECT_NEAR(contact.force[i], F[i], 1e-10);
    EXPECT_NEAR(contact.normal_force[i], i == 2 ? F[i] : 0, 1e-10);
    EXPECT_NEAR(contact.tangential_force[i], i == 2 ? 0 : F[i], 1e-10);
    EXPECT_NEAR(contact.moment[i], lever[j] * F[k] - lever[k] * F[j], 1e-10);
    EXPECT_NEAR(contact.displacement[i], i == 2 ? 0 : (i == 0 ? 0.02 - 2 * gx : 0.01 - 2 * gy), 1e-10) << "G = 1/2";
  }
  EXPECT_EQ(contact.slip_nodes, 15);
  EXPECT_EQ(contact.stick_nodes + contact.open_nodes, 0);
}

// What a sphere without friction presses with goes through its centre, wherever that is at t.
TEST(ObstacleForces, OfASphereHaveNoMomentAboutItsCentre) {
  const std::string scene =
      tables::block("block", "[0, 0]", "[2, 1]", "[8, 4]") + tables::fix("block", "top", "[0, 0]") + R"(
[[obstacle]]
type = "contact"
body = "block"
on = "bottom"
shape = "sphere"
center = [0.8, "-3.1 + 0.2 * t"]
radius = 3
[refine]
uniform = 2
[steps]
at = [0.75, 1]
)";
  Driver driver(scene_of(scene));
  driver.solve();
  for (const StepReport& step : driver.report().steps) {
    const ContactReport& contact = step.contact[0];
    EXPECT_THAT(contact.moment_about, ElementsAre(0.8, -3.1 + 0.2 * step.t));
    EXPECT_EQ(contact.motion[0], 0);
    EXPECT_NEAR(contact.motion[1], 0.2 * step.t, 1e-15) << "also before the first step";
    EXPECT_GT(contact.force[1], 1e-3);
    EXPECT_NEAR(contact.moment[0], 0, 1e-12);
    EXPECT_GT(contact.open_nodes, 0);
    EXPECT_EQ(contact.nodes + contact.open_nodes, 33);
  }
}

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

// The first step slips, the second one takes the block off the plane to the side.
TEST(ObstacleForces, AreZeroWhereNothingTouches) {
  const std::string scene = tables::block("block", "[0, 0]", "[2, 1]", "[8, 4]") +
                            tables::fix("block", "top", "['0.05 * t', 't < 0.7 ? -0.03 : 0.01']") +
                            tables::plane("block", "bottom", "[0, 0]", "[0, 1]") +
                            "[refine]\nuniform = 2\n[steps]\ncount = 2\n";
  Driver driver(scene_of(scene, {"obstacle.0.type=coulomb", "obstacle.0.friction=0.3"}));
  driver.solve();
  const ContactReport &pressed = driver.report().steps[0].contact[0], &open = driver.report().steps[1].contact[0];
  EXPECT_GT(pressed.slip_nodes, 0);
  EXPECT_GT(pressed.dissipated, 0);
  EXPECT_EQ(open.nodes, 0);
  EXPECT_THAT(open.tangential_force, ElementsAre(0, 0));
  EXPECT_THAT(open.force, ElementsAre(0, 0));
  // What slipped at first does so on while contact opens: by no more than the 0.05 of the top and the bulge.
  EXPECT_GT(open.dissipated_in_step, 0);
  EXPECT_LE(open.dissipated_in_step, 0.5 * 0.3 * pressed.force[1] * 0.06);
}

// Loads, reactions and obstacles with friction, step by step.
TEST(ObstacleForces, BalanceInEveryStepWithFriction) {
  const std::string steps = "[solver]\ntolerance = 1e-9\n[refine]\nuniform = 1\n[steps]\nat = [0.2, 0.3, 1]\n";
  const std::string scenes[] = {tables::block("block", "[0, 0]", "[2, 1]", "[8, 4]") +
                                    tables::fix("block", "top", "['0.02 * sin(5 * t)', '-0.03 * t']") +
                                    tables::load("block", "['0.002 * t', -0.001]") +
                                    friction_plane("0.004", "[0, 0]", "[0.1, 1]") + steps,
                                tables::block("block", "[0, 0, 0]", "[2, 1, 1]", "[4, 2, 2]") +
                                    tables::fix("block", "top", "['0.02 * sin(5 * t)', '0.01 * t', '-0.03 * t']") +
                                    tables::load("block", "[0, '0.003 * t', 0]", "right") +
                                    friction_plane("'0.008 * x'", "[0, 0, 0]", "[0, 0.1, 1]") + steps};
  for (const std::string& scene : scenes) {
    Driver driver(scene_of(scene));
    driver.solve();
    ASSERT_TRUE(driver.report().converged()) << driver.report().reason();
    ASSERT_EQ(driver.report().steps.size(), 3u);
    for (const StepReport& step : driver.report().steps) {
      const BalanceReport& balance = step.balance[0];
      EXPECT_GT(norm(step.contact[0].tangential_force), 1e-4);
      EXPECT_LE(norm(balance.sum()), 1e-7 * norm(balance.contact)) << step.t;
      EXPECT_NEAR(norm(balance.contact), norm(step.contact[0].force), 1e-14);
      EXPECT_GE(step.contact[0].dissipated_in_step, 0);
    }
  }
}

}  // namespace
}  // namespace signorini::test
