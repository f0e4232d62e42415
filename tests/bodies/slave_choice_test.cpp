#include <gmock/gmock.h>

#include "tests/bodies/scenes.hpp"

// Which of two bodies is the slave, why, and what of the report does not depend on it.

namespace signorini::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Two blocks on each other, pressed by 0.1, each free to slide along x.
struct Press {
  std::string lower_cells = "[4, 4]", upper_cells = "[4, 3]";
  std::string lower = material(1), upper = material(1);
  std::string obstacle = pair("upper", "bottom", "lower", "top");
  std::string more = "";
};

std::string text_of(const Press& press) {
  using tables::fix, tables::load;
  return tables::block("lower", "[0, 0]", "[1, 1]", press.lower_cells, press.lower) +
         tables::block("upper", "[0, 1]", "[1, 1.75]", press.upper_cells, press.upper) +
         fix("lower", "bottom", "[\"free\", 0]") + fix("lower", "left", "[0, \"free\"]") +
         fix("upper", "left", "[0, \"free\"]") + load("upper", "[0, -0.1]", "top") + press.obstacle + press.more;
}

ContactReport contact_of(const std::string& text) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  return report.last().contact[0];
}

PairReport pair_of(const Press& press) {
  const ContactReport contact = contact_of(text_of(press));
  return contact.pair.value_or(PairReport{});
}

const std::string turned = pair("lower", "top", "upper", "bottom");

TEST(Slave, IsTheSofterBody) {
  for (const double ratio : {2.1, 1e4})
    for (const std::string& obstacle : {Press().obstacle, turned}) {
      SCOPED_TRACE(obstacle);
      const PairReport upper = pair_of({.lower = material(ratio), .obstacle = obstacle});
      EXPECT_EQ(upper.slave, "upper");
      EXPECT_EQ(upper.master, "lower");
      EXPECT_EQ(upper.reason, fmt::format("softer: modulus 1 beside {:g}", ratio));
      EXPECT_EQ(pair_of({.upper = material(ratio), .obstacle = obstacle}).slave, "lower");
    }
}

// Where neither is much softer or finer any difference decides: not which of them is named first.
TEST(Slave, DoesNotDependOnWhichIsNamedFirst) {
  for (const std::string& obstacle : {Press().obstacle, turned}) {
    EXPECT_EQ(pair_of({.lower = material(1.2), .obstacle = obstacle}).slave, "upper");
    EXPECT_EQ(pair_of({.upper = material(1.2), .obstacle = obstacle}).slave, "lower");
  }
}

// A ratio of moduli of exactly two, but for the rounding of other units.
TEST(Slave, DoesNotDependOnUnits) {
  const PairReport plain = pair_of({.lower_cells = "[8, 4]", .lower = material(200000), .upper = material(100000)});
  const PairReport scaled =
      pair_of({.lower_cells = "[8, 4]", .lower = material(0.2), .upper = material(std::nextafter(0.1, 0))});
  EXPECT_EQ(plain.slave, scaled.slave);
  EXPECT_EQ(plain.reason.substr(0, 5), scaled.reason.substr(0, 5)) << plain.reason << ", " << scaled.reason;
}

/// The upper block, softer by half, with one more fix.
std::string with_fix(const std::string& fix, const std::string& obstacle) {
  return text_of({.lower = material(1.9), .obstacle = obstacle, .more = fix});
}

// A fix takes the place of contact at the slave's nodes: the lower block is the slave, though the upper one is softer.
TEST(Slave, HasNoNodesThatArePrescribedAlongTheNormal) {
  const std::string fixed = tables::fix("upper", "right", "[\"free\", -0.05]");
  const ContactReport contact = contact_of(with_fix(fixed, Press().obstacle));
  EXPECT_EQ(contact.pair->slave, "lower");
  EXPECT_EQ(contact.pair->reason, "nodes of the other side are prescribed");
  EXPECT_LT(contact.largest_penetration, 0.05 * contact.largest_displacement);
  // Where the scene wants it otherwise a warning says what that means.
  Driver driver(scene_of(with_fix(fixed, pair("upper", "bottom", "lower", "top", "slave = \"body\"\n"))));
  EXPECT_THAT(driver.solve().warnings, testing::Contains(HasSubstr("1 of 5 nodes of the slave on the coarsest mesh is "
                                                                   "prescribed along the normal")));
}

// A pad that is dragged along as a whole.
TEST(Slave, IsFreeToFeelFriction) {
  const std::string dragged = tables::fix("upper", "boundary", "[0.01, \"free\"]");
  const auto rough = [](const std::string& more) {
    return pair("upper", "bottom", "lower", "top", "friction = 0.2\n" + more, "elastic_coulomb");
  };
  const ContactReport contact = contact_of(with_fix(dragged, rough("")));
  EXPECT_EQ(contact.pair->slave, "lower");
  EXPECT_LT(contact.tangential_force[0], -5e-4);
  Driver driver(scene_of(with_fix(dragged, rough("slave = \"body\"\n"))));
  EXPECT_THAT(driver.solve().warnings, testing::Contains(HasSubstr("no friction acts there along what is prescribed")));
  EXPECT_EQ(driver.report().last().contact[0].tangential_force[0], 0);
}

TEST(Slave, IsTheFinerBodyWhereBothAreAboutAsSoft) {
  for (const std::string& obstacle : {Press().obstacle, turned}) {
    SCOPED_TRACE(obstacle);
    const PairReport upper = pair_of({.upper_cells = "[8, 3]", .upper = material(1.9), .obstacle = obstacle});
    EXPECT_EQ(upper.slave, "upper");
    EXPECT_EQ(upper.reason, "finer: faces of 0.125 beside 0.25, moduli 1.9 and 1");
    EXPECT_EQ(pair_of({.lower_cells = "[8, 3]", .lower = material(1.9), .obstacle = obstacle}).slave, "lower");
  }
}

TEST(Slave, IsTheFirstBodyWhereBothAreAlike) {
  EXPECT_EQ(pair_of({}).slave, "upper");
  EXPECT_EQ(pair_of({.obstacle = turned}).slave, "lower");
  EXPECT_EQ(pair_of({}).reason, "as stiff and as fine as the other one");
}

TEST(Slave, IsTheOneThatTheSceneNames) {
  const auto named = [](const char* which) {
    return pair_of({.lower = material(100), .obstacle = Press().obstacle + fmt::format("slave = \"{}\"\n", which)});
  };
  EXPECT_EQ(named("body").slave, "upper");
  EXPECT_EQ(named("other").slave, "lower");
  EXPECT_EQ(named("other").reason, "as the scene says");
}

// What counts is the material where the bodies touch.
TEST(Slave, IsJudgedNextToTheOtherBody) {
  const std::string soft_on_top = "order = 1\nyoung = \"1 + 100 * (1 - y)^4\"\npoisson = 0.3\n";
  const PairReport found = pair_of({.lower_cells = "[16, 16]", .lower = soft_on_top, .upper = material(3)});
  EXPECT_EQ(found.slave, "lower");
  EXPECT_THAT(found.reason, StartsWith("softer: modulus 1"));
}

// A disk whose faces are small where it touches, and large elsewhere.
TEST(Slave, IsTheFinerBodyWhereTheyTouch) {
  const PairReport found = *contact_of(
                                "[[body]]\nname = \"disk\"\nshape = \"half_disk\"\ncenter = [0, 1]\nradius = 1\n"
                                "size = \"0.03 + 0.4 * sqrt(x^2 + y^2)\"\n" +
                                material(1) + tables::block("block", "[-1, -1]", "[1, 0]", "[24, 12]") +
                                tables::fix("disk", "flat", "[0, -0.01]") + tables::fix("block", "bottom", "[0, 0]") +
                                pair("block", "top", "disk", "curved"))
                                .pair;
  EXPECT_EQ(found.slave, "disk");
  EXPECT_THAT(found.reason, StartsWith("finer: faces of 0.0"));
}

TEST(Slave, IsNoSideThatIsPrescribed) {
  using tables::fix;
  const std::string text = tables::block("lower", "[0, 0]", "[1, 1]", "[4, 4]", material(100)) +
                           tables::block("upper", "[0, 1]", "[1, 1.75]", "[4, 3]") + fix("lower", "bottom", "[0, 0]") +
                           fix("upper", "bottom", "[0, -0.01]") + Press().obstacle;
  const ContactReport contact = contact_of(text);
  EXPECT_EQ(contact.pair->slave, "lower");
  EXPECT_EQ(contact.pair->reason, "the other side is prescribed");
  EXPECT_GT(contact.force[1], 0);
  expect_error(text + "slave = \"body\"\n", Exit::input, "all nodes of the slave is prescribed");
  // Along the normal is enough.
  EXPECT_EQ(
      contact_of(tables::block("lower", "[0, 0]", "[1, 1]", "[4, 4]", material(100)) +
                 tables::block("upper", "[0, 1]", "[1, 1.75]", "[4, 3]") + fix("lower", "bottom", "[0, 0]") +
                 fix("upper", "bottom", "[\"free\", -0.01]") + fix("upper", "left", "[0, \"free\"]") + Press().obstacle)
          .pair->slave,
      "lower");
}

TEST(Slave, IsNoSideWhereARigidObstacleActs) {
  const PairReport found =
      pair_of({.lower = material(100), .more = tables::plane("upper", "bottom", "[0, 0.9]", "[0, 1]")});
  EXPECT_EQ(found.slave, "lower");
  EXPECT_THAT(found.reason, HasSubstr("obstacle.1 acts on the other side, too"));
}

// The soft body below both would be the slave twice at one node.
TEST(Slave, IsNoSideThatTouchesTwoBodiesAtANode) {
  using tables::block, tables::fix;
  Driver driver(scene_of(block("long", "[0, 0]", "[2, 1]", "[8, 4]", material(0.1)) +
                         block("left", "[0, 1]", "[1, 1.5]", "[5, 3]") +
                         block("right", "[1, 1]", "[2, 1.5]", "[5, 3]") + fix("long", "bottom", "[0, 0]") +
                         fix("left", "top", "[0, -0.01]") + fix("right", "top", "[0, -0.02]") +
                         pair("long", "top", "left", "bottom") + pair("long", "top", "right", "bottom")));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged());
  const auto& contact = report.last().contact;
  EXPECT_EQ(contact[0].pair->slave, "left");
  EXPECT_EQ(contact[1].pair->slave, "right");
  EXPECT_THAT(contact[0].pair->reason, HasSubstr("obstacle.1 acts on the other side, too"));
  for (const ContactReport& of : contact) {
    EXPECT_LT(of.force[1], 0) << "on the long one";
    expect_opposite(of);
  }
  expect_balance(report.last(), 1e-10);
}

// On a flat interface moments are opposite, too.
TEST(Slave, LeavesForcesAndMomentsOnTheNamedBodies) {
  for (const char* slave : {"body", "other"})
    for (const char* pairing : {"normal", "closest"}) {
      SCOPED_TRACE(fmt::format("{} {}", slave, pairing));
      const ContactReport contact = contact_of(
          text_of({.upper_cells = "[7, 3]",
                   .obstacle = Press().obstacle + fmt::format("slave = \"{}\"\npairing = \"{}\"\n", slave, pairing)}));
      EXPECT_EQ(contact.body, "upper");
      EXPECT_NEAR(contact.force[1], 0.1, 1e-11);
      EXPECT_NEAR(contact.normal_force[1], 0.1, 1e-11);
      EXPECT_NEAR(contact.moment[0], 0.05, 1e-11);
      EXPECT_NEAR(contact.pair->moment[0], -0.05, 1e-11);
      expect_opposite(contact);
    }
}

TEST(Slave, LeavesFrictionOnTheNamedBody) {
  using tables::block, tables::fix;
  for (const char* slave : {"body", "other"}) {
    SCOPED_TRACE(slave);
    const ContactReport contact =
        contact_of(block("lower", "[0, 0]", "[2, 1]", "[16, 8]") + block("upper", "[0.5, 1]", "[1.5, 1.5]", "[9, 4]") +
                   fix("lower", "bottom", "[0, 0]") + fix("upper", "top", "[0.02, -0.01]") +
                   pair("upper", "bottom", "lower", "top", fmt::format("friction = 0.2\nslave = \"{}\"\n", slave),
                        "elastic_coulomb"));
    EXPECT_LT(contact.force[0], 0) << "friction holds the upper one back";
    EXPECT_GT(contact.force[1], 0);
    EXPECT_NEAR(contact.tangential_force[0], contact.force[0], 1e-12);
    EXPECT_NEAR(contact.normal_force[1], contact.force[1], 1e-12);
    EXPECT_GT(contact.slip_nodes, 0);
    expect_opposite(contact);
  }
}

}  // namespace
}  // namespace signorini::test
