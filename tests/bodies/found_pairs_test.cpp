#include "driver/scene/found_pairs.hpp"

#include <gmock/gmock.h>

#include "tests/bodies/scenes.hpp"

// Obstacles between bodies that are found by their distance: the table [contact].

namespace signorini::test {
namespace {

using tables::block, tables::fix, tables::load;
using testing::ElementsAre, testing::HasSubstr;

std::string contact(const std::string& more = "", const std::string& between = "\"all\"") {
  return fmt::format("[contact]\nbetween = {}\n{}\n", between, more);
}

/// "a+b" per pair that is found.
std::vector<std::string> found(const std::string& text) {
  Scene scene = scene_of(text);
  std::vector<std::string> out;
  for (const FoundPair& pair : add_found_pairs(scene)) out.push_back(pair.body + "+" + pair.other);
  return out;
}

std::string refusal(const std::string& text) {
  try {
    Driver(scene_of(text)).solve();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  ADD_FAILURE() << "nothing is refused";
  return "";
}

/// Two unit squares on each other, a gap apart.
std::string two_blocks(double gap, const std::string& more = "") {
  return block("lower", "[0, 0]", "[1, 1]", "[2, 2]", material(100, 0, 2)) +
         block("upper", fmt::format("[0, {}]", 1 + gap), fmt::format("[1, {}]", 2 + gap), "[3, 3]",
               material(100, 0, 2)) +
         fix("lower", "bottom", "[0, 0]") + fix("upper", "top", "[0, -0.02]") + more;
}

TEST(FoundPairs, AreTheNeighboursOfAPoint) {
  const std::string blocks =
      block("sw", "[-5, -5]", "[0, 0]", "[4, 4]", material(1000, 0, 2)) +
      block("se", "[0, -5]", "[5, 0]", "[5, 5]", material(1000, 0, 2)) +
      block("ne", "[0, 0]", "[5, 5]", "[3, 3]", material(1000, 0, 2)) +
      block("nw", "[-5, 0]", "[0, 5]", "[6, 6]", material(1000, 0, 2)) + fix("sw", "left", "[0, \"free\"]") +
      fix("sw", "bottom", "[\"free\", 0]") + fix("nw", "left", "[0, \"free\"]") + fix("se", "bottom", "[\"free\", 0]") +
      load("se", "[-10, 0]", "right") + load("ne", "[-10, 0]", "right") + load("ne", "[0, -10]", "top") +
      load("nw", "[0, -10]", "top") + tables::probe("corner", "ne", "[5, 5]");
  EXPECT_THAT(found(blocks + contact()), ElementsAre("sw+se", "sw+nw", "se+ne", "ne+nw"));
  EXPECT_THAT(found(blocks + contact("", "[\"sw\", \"se\", \"ne\"]")), ElementsAre("sw+se", "se+ne"));
  for (const char* friction : {"", "friction = 0.3", "friction = \"0.3 + 0 * x\""}) {
    Driver driver(scene_of(blocks + contact(friction)));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    ASSERT_EQ(report.last().contact.size(), 4u);
    for (const ContactReport& contact : report.last().contact) EXPECT_NEAR(length(contact.force), 50, 1e-6);
    for (const double u : report.last().probes[0].value) EXPECT_NEAR(u, -0.1, 1e-8);
    EXPECT_EQ(driver.scene().obstacles[0].type, *friction ? "elastic_coulomb" : "elastic");
  }
}

// An obstacle of the scene takes the place of one that would be found.
TEST(FoundPairs, AreNotThoseOfTheScene) {
  const std::string third =
      block("third", "[1, 0]", "[2, 1]", "[2, 2]", material(100, 0, 2)) + fix("third", "bottom", "[0, 0]");
  const std::string tie = pair("upper", "bottom", "lower", "top", "", "tied");
  EXPECT_THAT(found(two_blocks(0, third + contact())), ElementsAre("lower+upper", "lower+third"));
  EXPECT_THAT(found(two_blocks(0, third + tie + contact())), ElementsAre("lower+third"));
  EXPECT_THAT(refusal(two_blocks(0, tie + contact())),
              HasSubstr("contact.between: an [[obstacle]] is between any two of the bodies"));
}

TEST(FoundPairs, AreWithinReach) {
  EXPECT_THAT(found(two_blocks(0.1, contact())), ElementsAre("lower+upper"));
  EXPECT_THAT(found(two_blocks(0.1, contact("reach = 0.11"))), ElementsAre("lower+upper"));
  EXPECT_THAT(refusal(two_blocks(0.1, contact("reach = 0.09"))),
              testing::AllOf(HasSubstr("contact.reach: "), HasSubstr("the nearest are 0.1 apart")));
  Scene scene = scene_of(two_blocks(0.1, contact()));
  EXPECT_NEAR(add_found_pairs(scene).at(0).distance, 0.1, 1e-12);
}

// What is behind another body is no partner, however far the reach.
TEST(FoundPairs, DoNotSeeThroughBodies) {
  std::string text;
  for (int k = 0; k < 3; ++k)
    text += block(fmt::format("b{}", k), fmt::format("[{}, 0]", k), fmt::format("[{}, 1]", k + 1), "[1, 1]",
                  material(100, 0, 2));
  text += fix("b0", "left", "[0, 0]") + fix("b2", "right", "[-0.03, 0]") + contact("reach = 5");
  EXPECT_THAT(found(text), ElementsAre("b0+b1", "b1+b2"));
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  for (const ContactReport& contact : report.last().contact) EXPECT_NEAR(contact.force[0], -100 * 0.03 / 3, 1e-6);
}

// Nor what is behind another part of the body itself: the lower arm of a clamp does not face what lies on the upper
// one.
TEST(FoundPairs, DoNotSeeThroughTheirOwnBody) {
  Scene scene = scene_of(
      "[[body]]\nname = \"clamp\"\nshape = \"polygon\"\npoints = [[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [4, 3], "
      "[4, 4], [0, 4]]\nsize = 0.5\n" +
      material(100) + block("block", "[2, 4]", "[4, 5]", "[4, 2]", material(100)) + fix("clamp", "boundary", "[0, 0]") +
      contact());
  ASSERT_EQ(add_found_pairs(scene).size(), 1u);
  const auto picks = [&](double x, double y) {
    return (*scene.obstacles[0].on->where)({.x = {x, y, 0}, .n = {0, 1, 0}}) != 0;
  };
  EXPECT_TRUE(picks(4, 4));
  EXPECT_FALSE(picks(4, 1));
}

// A body slides by more than its own width: the faces that it comes to are found as well.
TEST(FoundPairs, GoOnWhereStepsMoveBodiesTo) {
  std::vector<double> force;
  for (const std::string& how : {contact(), pair("upper", "bottom", "lower", "top")}) {
    Driver driver(scene_of(block("lower", "[0, 0]", "[4, 1]", "[8, 2]", material(100, 0.3, 2)) +
                           block("upper", "[0.5, 1]", "[1.5, 2]", "[3, 3]", material(100, 0.3, 2)) +
                           fix("lower", "bottom", "[0, 0]") + fix("upper", "top", "[\"2 * t\", -0.01]") + how +
                           "[steps]\ncount = 8\n"));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    force.push_back(std::abs(report.last().contact[0].force[1]));  // on either body
  }
  EXPECT_GT(force[1], 0.1);
  EXPECT_NEAR(force[0], force[1], 1e-6 * force[1]);
}

// Gaps and overlaps are closed without strain, or count.
TEST(FoundPairs, GoOnWhereASingleStepMovesBodiesTo) {
  const auto force = [](double from, double way) {
    Driver driver(scene_of(
        block("base", "[-3, -1]", "[3, 0]", "[24, 4]", material(1000)) +
        block("punch", fmt::format("[{}, 0]", from), fmt::format("[{}, 0.5]", from + 1), "[6, 3]", material(3000)) +
        fix("base", "bottom", "[0, 0]") + fix("punch", "top", fmt::format("[{}, -0.01]", way)) +
        "[contact]\nbetween = \"all\"\n"));
    const Report& report = driver.solve();
    EXPECT_TRUE(report.converged()) << report.reason();
    return report.last().contact[0].force[1];
  };
  const double drawn = std::abs(force(1, 0));
  for (const double way : {0.5, 1.5}) EXPECT_NEAR(std::abs(force(1 - way, way)), drawn, 0.02 * drawn) << way;
}

TEST(FoundPairs, CloseGapsUpToALength) {
  for (const double gap : {0.01, -0.01})
    for (const bool closed : {false, true}) {
      Driver driver(scene_of(two_blocks(gap, contact(closed ? "adjust = 0.011" : "adjust = 0.009"))));
      const Report& report = driver.solve();
      ASSERT_TRUE(report.converged()) << report.reason();
      const ContactReport& contact = report.last().contact[0];
      EXPECT_NEAR(std::abs(contact.force[1]), 100 * (0.02 - (closed ? 0 : gap)) / 2, 1e-6) << gap << " " << closed;
      EXPECT_LE(contact.largest_opening, 1e-9);
    }
}

// A half stands for the whole.
TEST(FoundPairs, GoOnBeyondAPlaneOfSymmetry) {
  std::vector<double> force;
  for (const bool half : {false, true}) {
    Driver driver(scene_of(block("lower", "[-2, 0]", "[2, 1]", "[8, 2]", material(100, 0.3, 2)) +
                           block("upper", "[-1, 1]", "[1, 2]", "[6, 3]", material(100, 0.3, 2)) +
                           fix("lower", "bottom", "[0, 0]") + fix("upper", "top", "[0, -0.02]") + contact() +
                           (half ? "[symmetry]\nx = 0\n" : "")));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    force.push_back(report.last().contact[0].force[1]);
  }
  EXPECT_NEAR(force[1], force[0], 1e-2 * std::abs(force[0]));
}

// Faces next to the plane see each other, and their images do.
TEST(FoundPairs, GoOnBeyondAPlaneOnWhichRoundBodiesTouch) {
  const auto disk = [](const char* name, double middle) {
    return fmt::format("[[body]]\nname = \"{}\"\nshape = \"disk\"\ncenter = [{}, 0]\nradius = 1\nsize = 0.1\n", name,
                       middle) +
           material(1, 0.3, 2);
  };
  const auto held = [](const char* name, const char* where, const char* by) {
    return fmt::format("[[fix]]\nbody = \"{}\"\nwhere = \"{}\"\nvalue = [{}, 0]\n", name, where, by);
  };
  std::vector<double> force;
  for (const std::string symmetry : {"", "[symmetry]\ny = 0\n"}) {
    Driver driver(scene_of(disk("left", -1) + disk("right", 1) + held("left", "x < -1.5", "0.02") +
                           held("right", "x > 1.5", "0") + contact() + symmetry));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    force.push_back(std::abs(report.last().contact[0].force[0]));
  }
  EXPECT_GT(force[0], 1e-3);
  EXPECT_NEAR(force[1], force[0], 0.05 * force[0]);
}

// In space, between a ball and a block, as the obstacle of the scene that picks the same.
TEST(FoundPairs, OfABallOnABlock) {
  const std::string text =
      "[[body]]\nname = \"ball\"\nshape = \"half_ball\"\ncenter = [0, 0, 1.01]\nradius = 1\nsize = 0.4\n"
      "young = 1\npoisson = 0.3\norder = 1\n" +
      block("block", "[-1, -1, -1]", "[1, 1, 0]", "[4, 4, 2]", material(1, 0.3)) + fix("block", "bottom", "[0, 0, 0]") +
      fix("ball", "flat", "[0, 0, -0.05]");
  std::vector<double> force;
  for (const std::string& how : {contact(), pair("ball", "curved", "block", "top")}) {
    Driver driver(scene_of(text + how));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    force.push_back(report.last().contact[0].force[2]);
  }
  EXPECT_GT(force[1], 0);
  EXPECT_NEAR(force[0], force[1], 1e-6 * force[1]);
}

TEST(FoundPairs, RefuseWhatHasNoMeaning) {
  const auto refused = [](const std::string& text, const std::string& part) {
    try {
      scene_of(text);
      ADD_FAILURE() << "nothing is refused, expected: " << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::input);
      EXPECT_THAT(error.what(), HasSubstr(part));
    }
  };
  refused(two_blocks(0, contact("", "[\"lower\", \"uper\"]")), "contact.between: there is no body 'uper'");
  refused(two_blocks(0, contact("", "\"lower\"")), "contact.between: expected \"all\", or the names of two bodies");
  refused(two_blocks(0, contact("", "[\"lower\", \"lower\"]")), "contact.between: body 'lower' is listed twice");
  refused(two_blocks(0, contact("friction = -1")), "contact.friction");
  refused(two_blocks(0, contact("adjust = -1")), "contact.adjust");
  refused(two_blocks(0, contact("frictoin = 1")), "frictoin");
  refused(two_blocks(0, "[contact]\nfriction = 0.1\n"), "between");
  refused(block("a", "[0, 0]", "[1, 1]", "[2, 2]") + fix("a", "bottom", "[0, 0]") + contact(),
          "contact.between: there are not two elastic bodies");
}

}  // namespace
}  // namespace signorini::test
