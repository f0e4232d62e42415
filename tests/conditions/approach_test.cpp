// Bodies with friction that come from a distance: what they move along the surface before they touch is no slip.
#include <gmock/gmock.h>

#include "driver/levels/approach.hpp"
#include "tests/bodies/scenes.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

using tables::block, tables::fix;
using testing::Contains, testing::HasSubstr, testing::Not;

constexpr const char* doubt = "bodies came along the surface before they touched";

/// A block whose bottom is at `height`, above a plane at zero or another block, and whose top moves by `by`.
std::string lowered(double height, const std::string& by, bool on_block, const std::string& more = "") {
  const std::string upper = block("upper", fmt::format("[0, {}]", height), fmt::format("[1, {}]", height + 0.5),
                                  "[16, 8]", material(1000, 0.3, 2)) +
                            fix("upper", "top", by) + more;
  if (!on_block)
    return upper + "[[obstacle]]\ntype = \"coulomb\"\nbody = \"upper\"\non = \"bottom\"\nfriction = 0.5\n" +
           "shape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\n";
  return upper + block("lower", "[-1, -1]", "[2, 0]", "[24, 8]", material(1000, 0.3, 2)) +
         fix("lower", "bottom", "[0, 0]") +
         pair("upper", "bottom", "lower", "top", "friction = 0.5\n", "elastic_coulomb");
}

Report report_of(const std::string& scene) {
  Driver driver(scene_of(scene));
  EXPECT_TRUE(driver.solve().converged()) << driver.report().reason();
  return driver.report();
}

// Of the way of the block a tenth is made in contact. All of it counted as slip: friction was 2.8 times too large.
TEST(Approach, IsNoSlip) {
  for (const bool on_block : {false, true}) {
    const ContactReport drawn = report_of(lowered(0, "[0.005, -0.01]", on_block)).last().contact[0];
    const Report come = report_of(lowered(0.09, "[\"0.05 * t\", \"-0.1 * t\"]", on_block));
    EXPECT_NEAR(come.last().contact[0].force[1], drawn.force[1], 0.01 * drawn.force[1]);
    EXPECT_NEAR(come.last().contact[0].force[0], drawn.force[0], -0.1 * drawn.force[0]);
    EXPECT_THAT(come.warnings, Not(Contains(HasSubstr("friction is in doubt"))));
    EXPECT_FALSE(come.failed.empty());
    // What does not depend on t cannot be cut.
    const Report whole = report_of(lowered(0.09, "[0.05, -0.1]", on_block));
    EXPECT_THAT(whole.warnings, Contains(HasSubstr(doubt)));
    EXPECT_LT(whole.last().contact[0].force[0], 2 * drawn.force[0]);
  }
}

// In a later step, and where the other body, or the obstacle, is what comes.
TEST(Approach, IsNoSlipInAnyFrame) {
  const double drawn = report_of(lowered(0, "[0.005, -0.01]", true)).last().contact[0].force[0];
  const Report later = report_of(lowered(0.09, "[\"0.05 * t\", \"-0.1 * t\"]", true, "[steps]\ncount = 3\n"));
  EXPECT_NEAR(later.last().contact[0].force[0], drawn, -0.1 * drawn);
  const Report up =
      report_of(block("b", "[0, 0.09]", "[1, 0.59]", "[16, 8]", material(1000, 0.3, 2)) + fix("b", "top", "[0, 0]") +
                "[[obstacle]]\ntype = \"coulomb\"\nbody = \"b\"\non = \"bottom\"\nfriction = 0.5\n"
                "shape = \"plane\"\npoint = [\"-0.05 * t\", \"0.1 * t\"]\nnormal = [0, 1]\n");
  const double on_plane = report_of(lowered(0, "[0.005, -0.01]", false)).last().contact[0].force[0];
  EXPECT_NEAR(up.last().contact[0].force[0], on_plane, -0.1 * on_plane);
}

/// A half disk that is moved straight down by `by` onto a rigid one from `height` above.
ContactReport onto_disk(double height, const std::string& by) {
  return report_of(fmt::format("[[body]]\nname = \"disk\"\nshape = \"half_disk\"\ncenter = [0, {}]\nradius = 1\n"
                               "size = \"0.02 + 0.3 * hypot(x, y - {})\"\n",
                               height + 1, height) +
                   material(1000, 0.3, 2) + fix("disk", "flat", by) +
                   "[[obstacle]]\ntype = \"coulomb\"\nbody = \"disk\"\non = \"curved\"\nfriction = 0.3\n"
                   "shape = \"sphere\"\ncenter = [0, -2]\nradius = 2\n")
      .last()
      .contact[0];
}

// Along the curved surfaces it moves away from the middle before it touches: friction drew it back, and the pressure
// was 16 % too small.
TEST(Approach, IsNoSlipOnRoundBodies) {
  const ContactReport come = onto_disk(0.2, "[0, \"-0.23 * t\"]"), drawn = onto_disk(0, "[0, \"-0.03 * t\"]");
  EXPECT_NEAR(come.max_pressure, drawn.max_pressure, 0.02 * drawn.max_pressure);
  EXPECT_NEAR(come.force[1], drawn.force[1], 0.01 * drawn.force[1]);
}

TEST(Approach, IsOfNoMatter) {
  const auto warnings = [](double height, const std::string& by) {
    return report_of(lowered(height, by, false)).warnings;
  };
  EXPECT_THAT(warnings(0, "[0.005, -0.01]"), Not(Contains(HasSubstr(doubt))));       // it touches at first
  EXPECT_THAT(warnings(0.09, "[0, -0.1]"), Not(Contains(HasSubstr(doubt))));         // straight down
  EXPECT_THAT(warnings(0.09, "[0.5, -0.1]"), Not(Contains(HasSubstr(doubt))));       // all slips in any case
  EXPECT_THAT(warnings(0.0002, "[0.005, -0.01]"), Not(Contains(HasSubstr(doubt))));  // a small part of the way
}

}  // namespace
}  // namespace signorini::test
