#include "driver/warnings/balance_warnings.hpp"

#include "tests/driver/warned.hpp"
#include "tests/support/problems.hpp"

// Loads that are lost are told, and loads that balance each other are not taken for lost.

namespace signorini::test {
namespace {

const std::string refined = "[refine]\nuniform = 2\n";
const std::string square = tables::block("block", "[0, 0]", "[1, 1]", "[7, 7]") +
                           tables::fix("block", "bottom", "[0, 0]") +
                           tables::plane("block", "right", "[1.01, 0]", "[-1, 0]");

Warnings told(const std::string& text) { return warnings(text + refined); }

auto warns_of(const std::string& body) {
  return Contains(AllOf(HasSubstr("body '" + body + "': forces balance up to"), HasSubstr("too small")));
}

TEST(BalanceWarnings, not_for_loads_that_cancel) {
  EXPECT_THAT(told(square + tables::load("block", "[-0.1, 0]", "left") + tables::load("block", "[0.1, 0]", "right")),
              Not(warns_of("block")));
  EXPECT_THAT(told(square + tables::load("block", "['0.1 * cos(pi * x)', 0]", "top")), Not(warns_of("block")));
}

// A prescribed boundary whose forces cancel, solved as far as rounding allows.
TEST(BalanceWarnings, forces_that_cancel_are_not_lost) {
  Driver driver(scene_of(tables::block("block", "[-1, -1]", "[1, 1]", "[4, 4]") +
                         tables::fix("block", "boundary", "['sin(x) * cos(y)', '0.5 * cos(x) * sin(y)']") +
                         "[solver]\ntolerance = 1e-17\n" + refined));
  EXPECT_TRUE(driver.solve().converged()) << driver.report().reason();
}

// The radial entry of a sum is none of forces that hold each other.
TEST(BalanceWarnings, not_for_radial_forces_of_axisymmetric_bodies) {
  const std::string ring = tables::block("ring", "[1, 0]", "[2, 1]", "[4, 4]",
                                         "plane = 'axisymmetric'\norder = 1\nyoung = 1\npoisson = 0.3\n") +
                           tables::fix("ring", "top", "['free', 0]") +
                           tables::plane("ring", "bottom", "[0, 0]", "[0, 1]");
  EXPECT_THAT(told(ring + tables::load("ring", "[0.05, 0]", "left")), Not(warns_of("ring")));
}

TEST(BalanceWarnings, for_loads_lost_beside_what_displacements_do) {
  const std::string pressed = tables::block("block", "[0, 0]", "[1, 1]", "[7, 7]") +
                              tables::fix("block", "top", "[0, -0.05]") +
                              tables::plane("block", "bottom", "[0, 0]", "[0, 1]");
  EXPECT_THAT(told(pressed + tables::load("block", "[0, -1e-16]")), warns_of("block"));
  EXPECT_THAT(told(pressed + tables::load("block", "[0, -1e-3]")), Not(warns_of("block")));
}

// Of bodies that touch each other each has loads of its own to be compared with.
TEST(BalanceWarnings, for_the_body_whose_loads_are_lost) {
  const std::string pair = tables::block("upper", "[0, 1]", "[1, 2]", "[3, 3]") +
                           tables::block("lower", "[0, 0]", "[1, 1]", "[4, 4]") +
                           tables::fix("lower", "bottom", "[0, 0]") + tables::fix("upper", "top", "[0, -0.02]") +
                           "[[obstacle]]\ntype = 'elastic'\nbody = 'upper'\non = 'bottom'\nother = 'lower'\nother_on "
                           "= 'top'\n" +
                           tables::load("upper", "[-0.01, 0]", "left") + tables::load("upper", "[0.01, 0]", "right");
  const auto both = told(pair + tables::load("lower", "[0, -1e-16]"));
  EXPECT_THAT(both, warns_of("lower"));
  EXPECT_THAT(both, Not(warns_of("upper")));
}

// What presses on a block from above and from below cancels, up to rounding, and is what acts there.
TEST(BalanceWarnings, not_for_a_body_between_two_others) {
  const std::string stack =
      tables::block("b0", "[0, 0]", "[1, 1]", "[3, 3]") + tables::block("b1", "[0, 1]", "[1, 2]", "[4, 3]") +
      tables::block("b2", "[0, 2]", "[1, 3]", "[5, 3]") + tables::fix("b0", "bottom", "[0, 0]") +
      tables::load("b2", "[0, -0.01]", "top") +
      "[[obstacle]]\ntype = 'elastic_coulomb'\nfriction = 0.3\nbody = 'b0'\non = 'top'\nother = 'b1'\n"
      "other_on = 'bottom'\n"
      "[[obstacle]]\ntype = 'elastic_coulomb'\nfriction = 0.3\nbody = 'b1'\non = 'top'\nother = 'b2'\n"
      "other_on = 'bottom'\n";
  EXPECT_THAT(told(stack), Not(Contains(HasSubstr("forces balance up to"))));
}

/// What is told of a body without loads on which a spring exerts this, and a fix that.
Warnings told_of(const std::vector<double>& spring, const std::vector<double>& fix, double rounding) {
  const Scene scene = scene_of(square + "[[spring]]\nbody = 'block'\non = 'top'\nstiffness = 1\n");
  const Mesh<2> mesh = cube<2>(0, 1, 1);
  const std::vector<double> none(2 * mesh.points.size());
  StepReport report;
  report.summary.outcome = Outcome::converged;
  report.bodies.push_back({"block", report.summary});
  report.springs.push_back({0, spring});
  report.reactions.push_back({0, fix});
  report.balance.push_back({"block", {0, 0}, {spring[0] + fix[0], spring[1] + fix[1]}, {0, 0}});
  return balance_warnings<2, 2>(scene, scene.bodies[0], Nodes<2>(mesh), none, report, none, rounding);
}

// A spring whose force nothing counters has been forgotten somewhere, whether or not there are loads and contact.
TEST(BalanceWarnings, for_forces_without_any_loads_and_contact) {
  const auto warned = Contains(HasSubstr("body 'block': forces balance up to"));
  EXPECT_THAT(told_of({-5, 0}, {0, 0}, 1e-12), warned);
  EXPECT_THAT(told_of({-5, 0}, {4.9, 0}, 1e-12), warned);
  EXPECT_THAT(told_of({-5, 0}, {5 - 1e-6, 0}, 1e-12), Not(warned));  // the tolerance
  EXPECT_THAT(told_of({-5e-13, 0}, {0, 0}, 1e-12), Not(warned));     // rounding
}

}  // namespace
}  // namespace signorini::test
