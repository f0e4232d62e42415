#include <algorithm>

#include "tests/bodies/scenes.hpp"

// Bodies solved in turns, the slave on the surface of the master, which feels its forces: the same answer as that of
// the joint problem.

namespace signorini::test {
namespace {

using tables::block, tables::fix;

const std::string in_turns = "bodies = \"dirichlet-neumann\"\n";

std::string solver(const std::string& more, double tolerance = 1e-9) {
  return fmt::format("[solver]\ntolerance = {}\n{}", tolerance, more);
}

/// @return turns
int expect_same(const std::string& text) {
  Driver jumps(scene_of(text + solver(""))), turns(scene_of(text + solver(in_turns + "max_iterations = 1000\n")));
  EXPECT_TRUE(jumps.solve().converged()) << jumps.report().reason();
  EXPECT_TRUE(turns.solve().converged()) << turns.report().reason();
  const std::vector<double> u = turns.solution(), expected = jumps.solution();
  double size = 0, apart = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    size = std::max(size, std::abs(expected[k]));
    apart = std::max(apart, std::abs(u[k] - expected[k]));
  }
  EXPECT_LT(apart, 1e-6 * size);
  const StepReport &a = turns.report().last(), &b = jumps.report().last();
  EXPECT_NEAR(a.summary.energy, b.summary.energy, 1e-6 * std::abs(b.summary.energy));
  for (std::size_t k = 0; k < a.contact.size(); ++k) {
    EXPECT_GT(a.contact[k].nodes, 0);
    EXPECT_EQ(a.contact[k].nodes, b.contact[k].nodes);
    for (std::size_t i = 0; i < a.contact[k].force.size(); ++i)
      EXPECT_NEAR(a.contact[k].force[i], b.contact[k].force[i], 1e-6 * length(b.contact[k].force));
    EXPECT_NEAR(a.contact[k].max_pressure, b.contact[k].max_pressure, 1e-4 * b.contact[k].max_pressure);
    EXPECT_NEAR(a.contact[k].area, b.contact[k].area, 0.05 * b.contact[k].area);  // edges lie within faces
    if (a.contact[k].pair) expect_opposite(a.contact[k]);
  }
  for (const BalanceReport& balance : a.balance)
    for (const double left : balance.sum()) EXPECT_NEAR(left, 0, 1e-5 * length(b.contact.back().force)) << balance.body;
  show("{} cycles, {}; jumps {} cycles\n", a.summary.iterations, a.summary.reason, b.summary.iterations);
  return a.summary.iterations;
}

/// A half disk on a block, in 3D a half ball.
std::string pressed(double young, int refinements, const std::string& more = "") {
  return "[[body]]\nname = \"disk\"\nshape = \"half_disk\"\ncenter = [0, 1]\nradius = 1\nsize = \"0.06 + 0.3 * "
         "sqrt(x^2 + y^2)\"\n" +
         material(1) + block("block", "[-2, -2]", "[2, 0]", "[32, 16]", material(young)) +
         fix("disk", "flat", "[0, -0.02]") + fix("block", "bottom", "[0, 0]") +
         pair("disk", "curved", "block", "top", more) + fmt::format("[refine]\nuniform = {}\n", refinements);
}

TEST(Turns, GiveTheSameAnswerWhateverTheStiffness) {
  for (const double young : {100.0, 4.0, 1.0}) expect_same(pressed(young, 2));
}

TEST(Turns, GiveTheSameAnswerWhicheverIsTheSlave) {
  for (const char* slave : {"body", "other"})
    expect_same(pressed(1, 1, fmt::format("slave = \"{}\"\npairing = \"closest\"\n", slave)));
}

TEST(Turns, GiveTheSameAnswerIn3D) {
  expect_same("[[body]]\nname = \"ball\"\nshape = \"half_ball\"\ncenter = [0, 0, 1]\nradius = 1\nsize = 0.35\n" +
              material(1) + block("block", "[-1, -1, -1]", "[1, 1, 0]", "[6, 6, 3]", material(3)) +
              fix("ball", "flat", "[0, 0, -0.1]") + fix("block", "bottom", "[0, 0, 0]") +
              pair("ball", "curved", "block", "top") + "[refine]\nuniform = 1\n");
}

// The middle one is a slave below and a master above.
TEST(Turns, GoThroughARowOfBodies) {
  expect_same(block("a", "[0, 0]", "[2, 1]", "[8, 4]", material(20)) +
              block("b", "[0.3, 1]", "[1.7, 1.5]", "[9, 3]", material(4)) +
              block("c", "[0.5, 1.5]", "[1.2, 2]", "[5, 4]") + fix("a", "bottom", "[0, 0]") +
              fix("b", "left", "[0, \"free\"]") + fix("c", "top", "[0.01, -0.02]") +
              "[[obstacle]]\ntype = \"contact\"\nbody = \"a\"\nwhere = \"x > 1.99 && y > 0.4\"\nshape = "
              "\"plane\"\npoint = [1.999, 0]\nnormal = [-1, 0]\n"
              "[[load]]\nbody = \"b\"\nvalue = [0, -0.001]\n" +
              pair("b", "bottom", "a", "top", "renew = false") + pair("c", "bottom", "b", "top", "renew = false") +
              "[refine]\nuniform = 2\n");
}

TEST(Turns, StepsStartFromTheLastOne) {
  const std::string text = block("a", "[0, 0]", "[2, 1]", "[8, 4]", material(3)) +
                           block("b", "[0.5, 1]", "[1.5, 1.5]", "[5, 3]") + fix("a", "bottom", "[0, 0]") +
                           fix("b", "top", "[0, \"-0.02 * t\"]") + pair("b", "bottom", "a", "top", "renew = false\n");
  expect_same(text + "[steps]\ncount = 3\n");
}

TEST(Turns, KnowNoFriction) {
  const std::string friction = pair("disk", "curved", "block", "top", "friction = 0.3\n", "elastic_coulomb");
  std::string text = pressed(1, 0);
  text = text.substr(0, text.find("[[obstacle]]")) + friction + solver(in_turns);
  expect_error(text, Exit::input, "friction between bodies is not available with bodies = \"dirichlet-neumann\"");
}

Report report_of_turns(const std::string& text, const std::string& more) {
  Driver driver(scene_of(text + solver(in_turns + more)));
  return driver.solve();
}

TEST(Turns, KeepTheLimitOfCyclesTogether) {
  const Report report = report_of_turns(pressed(1, 1), "max_iterations = 10\n");
  EXPECT_FALSE(report.converged());
  EXPECT_LE(report.last().summary.iterations, 20);
  EXPECT_EQ(report.last().summary.outcome, Outcome::iteration_limit);
  EXPECT_NE(report.reason().find("limit of 20 cycles of all bodies"), std::string::npos) << report.reason();
}

// Where the first turn goes too far nothing touches in the second one, and all bodies are at rest: no solution.
TEST(Turns, GoOnWhereAnInterferenceIsLost) {
  expect_same(block("lower", "[0, 0]", "[2, 1]", "[8, 4]", material(0.4)) +
              block("upper", "[0.3, 1]", "[1.73, 1.5]", "[7, 3]", material(1)) + fix("lower", "bottom", "[0, 0]") +
              fix("upper", "top", "[0, 0]") +
              pair("upper", "bottom", "lower", "top", "gap = -0.01\nslave = \"body\"\n"));
}

TEST(Turns, ComeToRestWhereTheMasterIsSofter) { expect_same(pressed(0.1, 0, "slave = \"body\"\n")); }

// In the first turn the ball, a master, is moved as it is: rounding is all that deforms it.
TEST(Turns, GoOnFromAMasterThatNothingDeformsYet) {
  const Report report =
      report_of_turns("[[body]]\nname = \"ball\"\nshape = \"half_ball\"\ncenter = [0, 0, 1]\nradius = 1\nsize = 0.4\n" +
                          material(1) + block("block", "[-1, -1, -1]", "[1, 1, 0]", "[8, 8, 4]", material(1)) +
                          fix("ball", "flat", "[0, 0, -0.05]") + fix("block", "bottom", "[0, 0, 0]") +
                          pair("ball", "curved", "block", "top", "slave = \"other\"\n") + "[symmetry]\nx = 0\ny = 0\n",
                      "");
  EXPECT_TRUE(report.converged()) << report.reason();
  EXPECT_GT(report.last().contact[0].force[2], 0);
}

TEST(Turns, EndWhereTheyLeadNowhere) {
  const Report report = report_of_turns(pressed(0.001, 0, "slave = \"body\"\n"), "max_iterations = 100000\n");
  EXPECT_FALSE(report.converged());
  EXPECT_LT(report.last().summary.iterations, 2000);
  EXPECT_NE(report.reason().find("expected the softer body as the slave"), std::string::npos) << report.reason();
}

TEST(Turns, NeedMastersThatFixesHold) {
  expect_error(block("a", "[0, 0]", "[2, 1]", "[8, 4]", material(1)) +
                   block("b", "[0.5, 1]", "[1.5, 1.5]", "[4, 3]", material(9)) + fix("a", "bottom", "[0, 0]") +
                   tables::load("b", "[0, -0.01]") + fix("b", "left", "[0, \"free\"]") +
                   pair("b", "bottom", "a", "top") + solver(in_turns),
               Exit::input, "expects fixes that hold masters");
}

}  // namespace
}  // namespace signorini::test
