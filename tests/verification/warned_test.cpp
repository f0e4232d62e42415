// What a solve cannot know, or what its mesh or linear elasticity leaves out, is said.
#include <gmock/gmock.h>

#include "apps/scenes/tables.hpp"
#include "driver/driver.hpp"
#include "run.hpp"

namespace signorini::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Report solved(const std::string& text) {
  Driver driver(parse_scene(text, "test.toml", "."));
  return driver.solve();
}

std::string round(double x, double top, double radius) {
  return fmt::format(
      "[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\non = \"bottom\"\nshape = \"sphere\"\ncenter = [{}, {}]\n"
      "radius = {}\n",
      x, top - radius, radius);
}

TEST(Warned, RoundsBetweenNodesAreNoticed) {
  const std::string block = tables::block("b", "[0, 0]", "[2, 1]", "[8, 4]") + tables::fix("b", "top", "[0, -0.05]");
  const Report coarse = solved(block + round(0.625, 0, 0.1));
  EXPECT_EQ(coarse.last().contact[0].nodes, 0);
  EXPECT_NEAR(coarse.last().contact[0].penetration_between_nodes, 0.05, 1e-12);
  EXPECT_THAT(coarse.warnings, Contains(HasSubstr("between its nodes")));
  const Report off = solved(block + round(0.625, -0.06, 0.1));
  EXPECT_EQ(off.last().contact[0].penetration_between_nodes, 0);
  EXPECT_THAT(off.warnings, Not(Contains(HasSubstr("between its nodes"))));
  const Report fine = solved(block + round(0.625, 0, 0.1) + "[refine]\nuniform = 4\n");
  EXPECT_GT(fine.last().contact[0].nodes, 1);
  EXPECT_THAT(fine.warnings, Not(Contains(HasSubstr("between its nodes"))));
}

// A turn of one degree moves the rim of a disk outwards by a fiftieth of what presses it.
TEST(Warned, SmallTurnsCountBesideWhatContactMoves) {
  for (const double angle : {0.02, 0.002}) {
    const Report r = solved(
        "[[body]]\nname = \"b\"\nshape = \"disk\"\ncenter = [0, 0]\nradius = 1\nsize = 0.3\nyoung = 1\npoisson = 0.3\n"
        "[[fix]]\nbody = \"b\"\nwhere = \"y > 0.2\"\n" +
        fmt::format("value = [\"-{0} * y\", \"{0} * x - 0.02\"]\n", angle) +
        tables::plane("b", "boundary", "[0, -1.01]", "[0, 1]"));
    EXPECT_GT(r.last().contact[0].nodes, 0);
    EXPECT_EQ(std::ranges::count_if(r.warnings, [](const auto& w) { return w.text.find("turns by") != w.text.npos; }),
              angle > 0.01)
        << angle;
  }
}

// A tip guided in a symmetric groove: what holds it sideways may be either wall, or the guide.
TEST(Warned, ObstaclesThatShareAGuidedNodeAreSaid) {
  std::string text =
      "[[body]]\nname = \"b\"\nshape = \"polygon\"\npoints = [[0, 0], [1, 2], [-1, 2]]\nsize = 0.5\norder = 1\nyoung = "
      "5\n"
      "poisson = 0.3\n" +
      tables::fix("b", "boundary", "[0, \"free\"]") + tables::load("b", "[0, -0.1]");
  const std::string one = text + tables::plane("b", "boundary", "[0, 0]", "[1, 1]");
  const Report both = solved(one + tables::plane("b", "boundary", "[0, 0]", "[-1, 1]")), alone = solved(one);
  Index undetermined = 0;
  double up = 0;
  for (const ContactReport& contact : both.last().contact) {
    undetermined += contact.undetermined_nodes;
    up += contact.force[1];
  }
  EXPECT_EQ(undetermined, 1);
  EXPECT_NEAR(up, 0.2, 1e-8);
  EXPECT_THAT(both.warnings, Contains(HasSubstr("is not determined")));
  EXPECT_EQ(alone.last().contact[0].undetermined_nodes, 0);
}

TEST(Warned, LargeTurnsAreSaid) {
  for (const double angle : {0.05, 0.15}) {
    for (const std::string from : {"[0, 0]", "[1000, -500]"}) {
      const double x = from == "[0, 0]" ? 0 : 1000, y = from == "[0, 0]" ? 0 : -500;
      const Report r = solved(tables::block("b", from, fmt::format("[{}, {}]", x + 2, y + 1), "[4, 2]") +
                              tables::fix("b", "bottom", fmt::format("['-{0}*(y-{1})', '{0}*(x-{2})']", angle, y, x)));
      EXPECT_EQ(std::ranges::count_if(r.warnings, [](const auto& w) { return w.text.find("turns by") != w.text.npos; }),
                angle > 0.1)
          << angle << from;
    }
  }
  const Report shear =
      solved(tables::block("b", "[0, 0]", "[2, 1]", "[4, 2]") + tables::fix("b", "boundary", "['0.3*y', '0.3*x']"));
  EXPECT_THAT(shear.warnings, Not(Contains(HasSubstr("turns by"))));
  const Report box = solved(tables::block("b", "[0, 0, 0]", "[1, 2, 3]", "[2, 2, 2]") +
                            tables::fix("b", "left", "['0.2*z', 0, '-0.2*x']"));
  EXPECT_THAT(box.warnings, Contains(HasSubstr("turns by 11 degrees")));
}

// Units in which rounding shows: forces that do not balance are no solution, whatever products with the matrix say.
TEST(Warned, WhereLoadsAreLostNothingIsClaimed) {
  const double unit = 0.3, length = 3000;
  const Report r = solved(
      tables::block("b", "[0, 0]", fmt::format("[{}, {}]", length * unit, unit), "[3000, 1]") +
      tables::fix("b", "left", "[0, 0]") + tables::load("b", fmt::format("[0, {}]", -8.2304526748971197e-15), "top") +
      tables::plane("b", "bottom", fmt::format("[0, {}]", -0.5 * unit), "[0, 1]") + "[refine]\nuniform = 2\n");
  EXPECT_FALSE(r.converged());
  EXPECT_THAT(r.reason(), HasSubstr("rounding"));
}

}  // namespace
}  // namespace signorini::test
