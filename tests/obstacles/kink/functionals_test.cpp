// Functionals of plugins beside friction and the kink: without numbers, with some that survive a load step, with forces
// along their normal, and with several directions.
#include <gmock/gmock.h>

#include "core/base/dense.hpp"
#include "driver/driver.hpp"
#include "run.hpp"
#include "scene_text.hpp"
#include "tests/support/convex.hpp"

namespace signorini::test {
namespace {

constexpr const char* plugins = "[plugins]\npath = [\"" SIGNORINI_KINK "\"]\n";

std::string membrane(const std::string& obstacle, const std::string& more = "") {
  const SceneText scene{.body =
                            "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]\n"
                            "equation = \"diffusion\"",
                        .fixes = {"on = \"left\"\nvalue = [0.2]", "on = \"right\"\nvalue = [-0.1]"},
                        .loads = {"value = [\"3 * sin(7 * x * y)\"]"},
                        .obstacle = obstacle,
                        .refinements = 2};
  return std::string(scene) + more + plugins;
}

// A bound that nothing meets, or an obstacle on a part of the body, must not make a difference either.
TEST(Functionals, NeedNoNumbersOfTheirOwn) {
  for (const std::string where : {"", "\nwhere = \"x < 0.8\""}) {
    const auto r = run<2, 1>(membrane("type = \"cost\"" + where), {"solver.tolerance=1e-11"});
    const auto& problem = r.problem();
    const auto prox = [&problem](double rho, Eigen::VectorXd& y) {
      for (Index p = 0; p < problem.A.size(); ++p)
        if (problem.fixed[p]) y[p] = problem.start[p];
      for (const Index p : problem.constraints.vector)
        if (!problem.fixed[p]) y[p] -= std::clamp(y[p], -0.01 / rho, 0.01 / rho);
    };
    const Eigen::VectorXd expected = convex_minimiser(dense(problem.A), vector(problem.b), prox, 1e-13);
    EXPECT_LE((vector(r.solution.x) - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
  }
}

TEST(Functionals, KeepTheirNumbersFromStepToStep) {
  const auto r = run<2, 1>(membrane("type = \"hardening\""), {"solver.tolerance=1e-11"});
  const DiscreteProblem<1>& problem = r.problem();
  Eigen::MatrixXd A = dense(problem.A);
  for (Index slot = 0; slot < problem.constraints.size(); ++slot)
    if (const Index p = problem.constraints.vector[slot]; !problem.fixed[p])
      A(p, p) += problem.constraints.data[2 * slot + 1] * std::abs(r.u()[p]);
  const Eigen::VectorXd expected = SymmetricFactors(A).solve(vector(problem.b));

  Driver driver(parse_scene(membrane("type = \"hardening\"", "[solver]\ntolerance = 1e-11\n[steps]\ncount = 2\n"),
                            "test.toml", "."));
  ASSERT_TRUE(driver.solve().converged()) << driver.report().reason();
  const Eigen::VectorXd second = vector(driver.solution());
  EXPECT_LE((second - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
  EXPECT_GE((second - vector(r.u())).cwiseAbs().maxCoeff(), 0.1 * second.cwiseAbs().maxCoeff()) << "no test";
}

// Nothing but springs carries the load.
TEST(Functionals, HaveTheirForcesInTheReport) {
  SceneText scene{
      .body = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\norder = 1\nyoung = 1\npoisson = 0.3",
      .fixes = {"on = \"top\"\nvalue = [0, \"free\"]"},
      .loads = {"on = \"top\"\nvalue = [0.01, \"-0.1 - 0.02*x\"]"},
      .obstacle = "type = \"spring\"\non = \"bottom\"",
      .refinements = 2};
  Driver driver(parse_scene(std::string(scene) + plugins, "test.toml", "."));
  const StepReport& step = driver.solve().last();
  ASSERT_TRUE(step.summary.converged()) << step.summary.reason;
  EXPECT_NEAR(step.contact[0].force[1], 0.24, 1e-7);
  EXPECT_NEAR(step.contact[0].force[0], 0, 1e-7);
  EXPECT_EQ(step.contact[0].slip_nodes + step.contact[0].stick_nodes, 0) << "this is no friction";
  EXPECT_EQ(step.contact[0].dissipated, 0);
  for (const double rest : step.balance[0].sum()) EXPECT_NEAR(rest, 0, 1e-7);
  EXPECT_THAT(driver.report().warnings, testing::IsEmpty());
}

TEST(Functionals, HaveTheirDirectionsAsComponents) {
  SceneText scene{
      .body =
          "shape = \"box\"\nfrom = [0, 0, 0]\nto = [2, 1, 1]\ncells = [4, 2, 2]\norder = 1\nyoung = 10\npoisson = 0.3",
      .fixes = {"on = \"top\"\nvalue = [0.03, 0.01, -0.05]"},
      .obstacle = "type = \"rail\"\non = \"bottom\"",
      .refinements = 1};
  const auto r = run<3, 3>(std::string(scene) + plugins);
  double off = 0, along = 0;
  for (std::size_t p = 0; p < r.mesh().points.size(); ++p) {
    if (r.mesh().points[p][2] != 0) continue;
    const double x = r.u()[3 * p], y = r.u()[3 * p + 1];
    off = std::max(off, std::abs(std::cos(0.5) * x + std::sin(0.5) * y));
    along = std::max(along, std::abs(std::cos(0.5) * y - std::sin(0.5) * x));
  }
  EXPECT_LE(off, 1e-14);
  EXPECT_GE(along, 1e-3);
}

void expect_refused(const char* type, const char* why) {
  try {
    run<2, 1>(membrane(std::string("type = \"") + type + "\""));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    EXPECT_THAT(error.what(), testing::HasSubstr(why));
  }
}

TEST(Functionals, OfTooManyNumbersAreRefused) { expect_refused("greedy", "9 numbers of its own, expected 0 to 8"); }

TEST(Functionals, WithoutALinearisationAreRefused) {
  expect_refused("vague", "has a functional without its linearisation");
}

TEST(Functionals, OfWrongDescriptorsAreRefused) {
  expect_refused("wide", "describes 3 components of 'value', expected 1 to 1");
  expect_refused("nameless", "describes direction 0 without a name");
  expect_refused("silent", "bounds a direction at (");
}

TEST(Functionals, WithMoreNumbersThanTheyTellOfAreRefused) {
  expect_refused("talkative", "gives its functional 2 numbers at (");
}

// A result that else passes for solved.
TEST(Functionals, ThatDoNotMinimiseOrContradictThemselvesAreRefused) {
  expect_refused("idle", "which is no minimiser: there is less energy at");
  expect_refused("contrary", "a fault of the plugin");
}

// Fields of the user are finite and axes are normalised by who asks for them.
TEST(Functionals, OfDirectionsAndBoundsThatAreNoneAreRefused) {
  expect_refused("long_direction", "the plugin gives direction 0 of length 2, expected a unit vector");
  expect_refused("no_direction", "the plugin gives direction 0 of length nan, expected a unit vector");
  expect_refused("no_bound", "the plugin gives direction 0 a bound that is not a number");
}

TEST(Functionals, FailWhateverStatusTheyName) { expect_refused("shrug", "obstacle.0: it cannot"); }

/// Nothing but the drag c = 4 holds the body: c du/dt = 1, everywhere alike.
std::string viscous(const std::string& type, const std::string& steps, const std::string& more = "") {
  const SceneText scene{
      .body = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]\nequation = \"diffusion\"",
      .loads = {"value = [1]"},
      .obstacle = "type = \"" + type + "\"\n" + more,
      .refinements = 1};
  return std::string(scene) + "[solver]\ntolerance = 1e-12\n[steps]\n" + steps + "\n" + plugins;
}

void expect_moved(const Driver& driver, double t) {
  for (const double u : driver.solution()) EXPECT_NEAR(u, t / 4, 1e-9);
}

TEST(Functionals, IntegrateInTimeByTheLengthOfTheirSteps) {
  Driver driver(parse_scene(viscous("drag", "at = [0.1, 0.4, 1]"), "test.toml", "."));
  std::size_t step = 0;
  const double ends[] = {0.1, 0.4, 1};
  driver.solve([&] { expect_moved(driver, ends[step++]); });
  EXPECT_EQ(step, 3u);
  EXPECT_TRUE(driver.report().converged()) << driver.report().reason();
}

TEST(Functionals, IntegrateInTimeOverStepsThatAreCut) {
  Driver driver(parse_scene(viscous("drag", "at = [0.25, 1]", "longest = 0.4"), "test.toml", "."));
  driver.solve();
  ASSERT_TRUE(driver.report().converged()) << driver.report().reason();
  ASSERT_EQ(driver.report().failed.size(), 1u);
  EXPECT_EQ(driver.report().failed[0].step, 2);
  expect_moved(driver, 1);
}

TEST(Functionals, MayForbidThatStepsAreCut) {
  Driver driver(parse_scene(viscous("stubborn_drag", "at = [0.25, 1]", "longest = 0.4"), "test.toml", "."));
  driver.solve();
  EXPECT_FALSE(driver.report().converged());
  EXPECT_TRUE(driver.report().failed.empty());
  EXPECT_THAT(driver.report().reason(), testing::HasSubstr("obstacle.0 does not admit that the step is cut in two"));
}

// Two bars of E = 1 and length 1 that are 0.1 apart, k = 1/4 between them, the end of the second one pulled by 0.3: the
// way d that they come apart is 0.3 - 2 k d / E, and nothing bounds them.
TEST(Functionals, BetweenBodiesActWhereNothingTouches) {
  const auto bar = [](const char* name, const char* from, const char* to, int order) {
    return std::string("[[body]]\nname = \"") + name + "\"\nshape = \"rectangle\"\nfrom = " + from + "\nto = " + to +
           "\ncells = [2, 2]\nyoung = 1\npoisson = 0\norder = " + std::to_string(order) + "\n";
  };
  for (const auto& [order, uniform] : {std::pair(1, 0), std::pair(1, 2), std::pair(2, 1)}) {
    Driver driver(parse_scene(bar("a", "[0, 0]", "[1, 1]", order) + bar("b", "[1.1, 0]", "[2.1, 1]", order) +
                                  "[[fix]]\nbody = \"a\"\non = \"left\"\nvalue = [0, 0]\n"
                                  "[[fix]]\nbody = \"b\"\non = \"right\"\nvalue = [0.3, 0]\n"
                                  "[[obstacle]]\ntype = \"cushion\"\nbody = \"a\"\non = \"right\"\nother = \"b\"\n"
                                  "other_on = \"left\"\n[solver]\ntolerance = 1e-11\n[refine]\nuniform = " +
                                  std::to_string(uniform) + "\n" + plugins,
                              "test.toml", "."));
    const StepReport& step = driver.solve().last();
    ASSERT_TRUE(step.summary.converged()) << step.summary.reason;
    const double d = 0.3 / 1.5;
    EXPECT_NEAR(step.summary.energy, 0.5 * 0.25 * d * d + 2 * 0.5 * (0.25 * d) * (0.25 * d), 1e-9);
    EXPECT_NEAR(step.contact[0].force[0], 0.25 * d, 1e-8);
    const std::vector<double> u = driver.solution(), points = driver.points();
    for (std::size_t v = 0; v < u.size(); v += 2)
      EXPECT_NEAR(u[v], points[v] <= 1 ? 0.25 * d * points[v] : 0.3 - 0.25 * d * (2.1 - points[v]), 1e-8);
  }
}

// The matrix is not to blame.
TEST(Functionals, WithoutAnAnswerAreToldWithTheirLibrary) {
  try {
    Driver(parse_scene(membrane("type = \"lost\""), "test.toml", ".")).solve();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    EXPECT_THAT(error.what(), testing::AllOf(testing::StartsWith("test.toml:"), testing::HasSubstr("obstacle.0: at ("),
                                             testing::HasSubstr("the result of the local solver is (nan)"),
                                             testing::HasSubstr("libsignorini_obstacle_lost.so)")));
  }
}

}  // namespace
}  // namespace signorini::test
