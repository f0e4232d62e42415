#include "driver/warnings/strain_warnings.hpp"

#include "tests/driver/warned.hpp"

// What linear elasticity says of large strains is warned of, and refused where a body would be pressed through itself.

namespace signorini::test {
namespace {

/// A block of height 1 on a plane, its top moved down.
std::string squeezed(double by, const std::string& material, bool flat = true) {
  return tables::block("block", flat ? "[0, 0]" : "[0, 0, 0]", flat ? "[1, 1]" : "[1, 1, 1]",
                       flat ? "[4, 4]" : "[2, 2, 2]", material) +
         tables::fix("block", "top", flat ? fmt::format("[0, {}]", -by) : fmt::format("[0, 0, {}]", -by)) +
         tables::plane("block", "bottom", flat ? "[0, 0]" : "[0, 0, 0]", flat ? "[0, 1]" : "[0, 0, 1]");
}

TEST(StrainWarnings, a_body_pressed_through_itself_is_refused) {
  const std::string material = "young = 1\npoisson = 0.3\n";
  for (const std::string more : {"", "order = 2\n", "plane = 'axisymmetric'\n", "plane = 'stress'\n"})
    EXPECT_THAT(refused(squeezed(1.5, material + more)), AllOf(HasSubstr("body.0"), HasSubstr("pressed through itself"),
                                                               HasSubstr(" at ("), HasSubstr("units")));
  EXPECT_THAT(refused(squeezed(1.5, material, false)), HasSubstr("pressed through itself"));
  EXPECT_THAT(refused(squeezed(1.5, material) + "[steps]\nat = [0.01, 1]\n"), HasSubstr("pressed through itself"));
}

TEST(StrainWarnings, large_strains_are_warned_of) {
  const std::string material = "young = 1\npoisson = 0.3\n";
  EXPECT_THAT(warnings(squeezed(0.3, material)), Contains(HasSubstr("strains are up to -0.")));
  EXPECT_THAT(warnings(squeezed(0.02, material)), Not(Contains(HasSubstr("strains"))));
}

// A displacement that is prescribed says what it means, whether there is an obstacle or not.
TEST(StrainWarnings, a_body_moved_through_itself_is_refused) {
  const auto moved = [](const std::string& by) {
    return tables::block("block", "[0, 0]", "[1, 1]", "[4, 4]") + tables::fix("block", "bottom", "[0, 0]") +
           tables::fix("block", "top", by);
  };
  EXPECT_THAT(refused(moved("[0, 10]")), HasSubstr("pressed through itself"));
  EXPECT_THAT(refused(moved("[5, 0]")), HasSubstr("pressed through itself"));
  EXPECT_EQ(refused(moved("[0, 0.1]")), "not refused");
}

// Where nothing touches anything all is proportional to the loads.
TEST(StrainWarnings, without_obstacles_results_may_be_scaled) {
  const std::string bar = tables::block("bar", "[0, 0]", "[4, 1]", "[8, 2]") + tables::fix("bar", "left", "[0, 0]") +
                          tables::load("bar", "[0, -1]", "right");
  EXPECT_THAT(warnings(bar), Contains(AllOf(HasSubstr("strains are up to"), HasSubstr("through itself"))));
}

// Singular strains at the rims of a punch are those of a few elements.
TEST(StrainWarnings, not_for_strains_at_corners) {
  const std::string pressed = tables::block("block", "[-4, -4]", "[4, 0]", "[32, 16]") +
                              tables::fix("block", "bottom", "[0, 0]") +
                              "[[fix]]\nbody = 'block'\nwhere = 'y == 0 && abs(x) <= 0.5'\nvalue = [0, -0.05]\n" +
                              tables::plane("block", "left", "[-4.01, 0]", "[1, 0]") + "[refine]\nuniform = 2\n";
  EXPECT_THAT(warnings(pressed), Not(Contains(HasSubstr("strains"))));
}

// The plane's normal leads into the body: the body is moved to its other side.
TEST(StrainWarnings, an_obstacle_on_the_wrong_side_is_named) {
  const std::string reversed = tables::block("block", "[0, 0]", "[1, 1]", "[4, 4]") +
                               tables::fix("block", "bottom", "[0, 0]") +
                               tables::plane("block", "top", "[0, -0.5]", "[0, -1]");
  EXPECT_THAT(refused(reversed),
              AllOf(HasSubstr("pressed through itself"), HasSubstr("on the wrong side ('normal', 'inside')?")));
}

}  // namespace
}  // namespace signorini::test
