#include <algorithm>
#include <array>
#include <cmath>

#include "tests/bodies/scenes.hpp"

// Friction where a fix prescribes something: how forces divide between the fix and a rigid obstacle, or another body.

namespace signorini::test {
namespace {

using tables::block, tables::fix, tables::load;

constexpr double friction = 0.3, weight = 0.01;
const std::string elastic = "young = 1\npoisson = 0.3\norder = 1\n";

std::string floor(const std::string& point, const std::string& normal) {
  return fmt::format(
      "[[obstacle]]\ntype = \"coulomb\"\nbody = \"block\"\non = \"bottom\"\nshape = \"plane\"\npoint = {}\nnormal = "
      "{}\n"
      "friction = {}\n",
      point, normal, friction);
}

std::string pressed_block() {
  return block("block", "[0, 0]", "[1, 0.5]", "[4, 2]", elastic) +
         load("block", fmt::format("[0, -{}]", weight), "top") + floor("[0, 0]", "[0, 1]");
}

const Report& solved(Driver& driver) {
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  for (const StepReport& step : report.steps) expect_balance(step, 1e-9 * weight);
  return report;
}

// A block that is drawn by its left side, which may move up and down: all of it slides, what is prescribed, too.
TEST(FrictionAtFixes, OfWhatIsDrawnIsAllOfIt) {
  Driver driver(scene_of(pressed_block() + fix("block", "left", "[\"0.05 * t\", \"free\"]") + "[steps]\ncount = 2\n"));
  for (const StepReport& step : solved(driver).steps) {
    EXPECT_NEAR(step.contact[0].tangential_force[0], -friction * weight, 1e-8 * weight);
    EXPECT_NEAR(step.reactions[0].force[0], friction * weight, 1e-8 * weight);
    EXPECT_EQ(step.contact[0].stick_nodes, 0);
  }
}

// A corner that is held along both directions, and led along the floor.
TEST(FrictionAtFixes, OfWhatIsHeldAndLedIsAllOfIt) {
  Driver driver(scene_of(pressed_block() + fix("block", "left", "[\"0.05 * t\", 0]") + "[steps]\ncount = 2\n"));
  for (const StepReport& step : solved(driver).steps) {
    const ContactReport& contact = step.contact[0];
    EXPECT_GT(contact.undetermined_nodes, 0);
    EXPECT_NEAR(contact.tangential_force[0], -friction * contact.normal_force[1], 1e-8 * weight);
    EXPECT_EQ(contact.slip_nodes, contact.nodes);
  }
}

// What does not move does not slip, and friction holds it as it was left.
TEST(FrictionAtFixes, NothingSlipsInAStepWithoutMotion) {
  Driver driver(scene_of(pressed_block() + fix("block", "left", "[\"0.05 * min(1, 2 * t)\", \"free\"]") +
                         "[steps]\ncount = 4\n"));
  const Report& report = solved(driver);
  EXPECT_EQ(report.steps[1].contact[0].slip_nodes, report.steps[1].contact[0].nodes);
  for (const std::size_t step : {2, 3}) {
    const ContactReport& contact = report.steps[step].contact[0];
    EXPECT_EQ(contact.slip_nodes, 0);
    EXPECT_EQ(contact.dissipated_in_step, 0);
    EXPECT_LE(std::abs(contact.tangential_force[0]), friction * weight * (1 + 1e-8));
  }
}

/// A block on an inclined floor whose left side goes with the floor along a direction that is no axis.
Scene carried(const std::array<double, 2>& direction, const std::string& by, const std::string& floor_by) {
  const auto along = [&](const std::string& way) {
    return fmt::format("[\"{:.17g} * ({})\", \"{:.17g} * ({})\", ", direction[0], way, direction[1], way);
  };
  return scene_of(block("block", "[0, 0, 0]", "[1, 1, 0.5]", "[3, 3, 2]", elastic) +
                  fix("block", "top", along(by) + "-0.01]") +
                  "[[fix]]\nbody = \"block\"\non = \"left\"\nvalue = " + along(by) + "\"free\"]\n" +
                  floor(along(floor_by) + "0]", "[0, 0, 1]") + "[steps]\ncount = 5\n[solver]\ntolerance = 1e-10\n");
}

// The floor takes the block along: whatever rounding leaves of two equal motions is no slip, at whose edge friction
// would be as large as it may be, in any direction.
TEST(FrictionAtFixes, NoneIsCreditedWhereFixAndObstacleGoTogether) {
  const std::array<double, 2> direction{0.6, 0.8};
  Driver moving(carried(direction, "t / 3", "t / 3")), resting(carried(direction, "0", "0"));
  const Report &a = solved(moving), &b = solved(resting);
  for (std::size_t step = 0; step < a.steps.size(); ++step) {
    SCOPED_TRACE(step);
    const ContactReport &with = a.steps[step].contact[0], &without = b.steps[step].contact[0];
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(with.force[i], without.force[i], 1e-7 * without.force[2]) << i;
    EXPECT_EQ(with.slip_nodes, without.slip_nodes);
    EXPECT_EQ(with.stick_nodes, without.stick_nodes);
    EXPECT_TRUE(step == 0 || with.slip_nodes == 0);
  }
}

// At every node that is led friction is against the way that it is led, and as large as the law says.
TEST(FrictionAtFixes, IsAgainstTheWayInSpace) {
  const std::array<double, 2> direction{0.6, 0.8};
  Driver driver(carried(direction, "0.1 * t", "0"));
  const ContactReport& contact = solved(driver).last().contact[0];
  EXPECT_EQ(contact.stick_nodes, 0);
  const double limit = friction * contact.normal_force[2];
  EXPECT_NEAR(std::hypot(contact.tangential_force[0], contact.tangential_force[1]), limit, 0.02 * limit);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(contact.tangential_force[i], -direction[i] * limit, 0.05 * limit);
}

// A blade that is pressed onto a drum rolls onto it, so that in each step other nodes touch than in the last one. What
// these moved before is, in long steps, more than what they slip, and the other way: friction must not turn round.
TEST(FrictionAtFixes, DoesNotTurnRoundInLongSteps) {
  const auto scene = [](int count, int halvings) {
    return scene_of(block("blade", "[0, 0]", "[50, 0.05]", "[200, 1]", "order = 2\nyoung = 210000\npoisson = 0.3\n") +
                    fix("blade", "right", "[0, \"-2 * t\"]") +
                    "[[obstacle]]\ntype = \"coulomb\"\nfriction = 0.2\nbody = \"blade\"\non = \"bottom\"\n"
                    "shape = \"sphere\"\ncenter = [5, -50]\nradius = 50\n" +
                    fmt::format("[steps]\ncount = {}\nhalvings = {}\n", count, halvings));
  };
  Driver eight(scene(8, 4)), four(scene(4, 4)), whole(scene(4, 0));
  const Report& fine = eight.solve();
  ASSERT_TRUE(fine.converged());
  for (const StepReport& step : fine.steps) EXPECT_GT(step.contact[0].tangential_force[0], 0);
  EXPECT_TRUE(fine.failed.empty());
  const Report& coarse = four.solve();
  ASSERT_TRUE(coarse.converged());
  EXPECT_NEAR(coarse.last().contact[0].tangential_force[0], fine.last().contact[0].tangential_force[0],
              1e-3 * fine.last().contact[0].tangential_force[0]);
  EXPECT_FALSE(coarse.failed.empty());
  // A single step has none before it that tells which way friction acts.
  Driver uncut(scene(1, 0));
  EXPECT_TRUE(std::ranges::any_of(uncut.solve().warnings, [](const std::string& warning) {
    return warning.find("contact moved on") != std::string::npos;
  }));
  // Where steps may not be cut a warning says so.
  const Report& turned = whole.solve();
  EXPECT_LT(turned.last().contact[0].tangential_force[0], 0);
  EXPECT_TRUE(std::ranges::any_of(turned.warnings, [](const std::string& warning) {
    return warning.find("friction turned round") != std::string::npos;
  }));
}

/// A block on a longer one, pressed on it, whose left side is drawn along.
std::string drawn(int dimension, int order, const std::string& left, const std::string& more) {
  const std::string alike = material(1, 0.3, order);
  const auto point = [&](double x, double y, double z) {
    return dimension == 2 ? fmt::format("[{}, {}]", x, z) : fmt::format("[{}, {}, {}]", x, y, z);
  };
  const auto cells = [&](int x, int y, int z) {
    return dimension == 2 ? fmt::format("[{}, {}]", x, z) : fmt::format("[{}, {}, {}]", x, y, z);
  };
  return block("lower", point(0, 0, 0), point(3, 1, 1), cells(7, 2, 2), alike) +
         block("upper", point(1, 0.2, 1), point(2, 0.8, 1.5), cells(5, 3, 2), alike) +
         fix("lower", "bottom", dimension == 2 ? "[0, 0]" : "[0, 0, 0]") + fix("upper", "left", left) +
         load("upper", dimension == 2 ? fmt::format("[0, -{}]", weight) : fmt::format("[0, 0, -{}]", weight), "top") +
         pair("upper", "bottom", "lower", "top", fmt::format("friction = {}\n{}", friction, more), "elastic_coulomb") +
         "[steps]\ncount = 2\n";
}

// All of it slides: whichever body is the slave friction is all of what presses.
TEST(FrictionAtFixesOfBodies, IsAllOfIt) {
  for (const int dimension : {2, 3})
    for (const int order : {1, 2}) {
      const double pressed = dimension == 2 ? weight : 0.6 * weight;
      const std::string left = dimension == 2 ? "[\"0.1 * t\", \"free\"]" : "[\"0.1 * t\", 0, \"free\"]";
      std::vector<double> reaction;
      for (const char* slave : {"body", "other", "auto"}) {
        SCOPED_TRACE(fmt::format("{}D, order {}, slave {}", dimension, order, slave));
        Driver driver(scene_of(drawn(dimension, order, left, fmt::format("slave = \"{}\"\n", slave))));
        const Report& report = driver.solve();
        ASSERT_TRUE(report.converged()) << report.reason();
        for (const StepReport& step : report.steps) {
          const ContactReport& contact = step.contact[0];
          EXPECT_NEAR(contact.normal_force[dimension - 1], pressed, 1e-6 * pressed);
          EXPECT_NEAR(contact.tangential_force[0], -friction * pressed,
                      dimension == 2 ? 1e-6 * pressed : 0.01 * friction * pressed);
          EXPECT_EQ(contact.stick_nodes, 0);
          // The nodes that are led are no pairs, and touch.
          if (contact.pair->slave == "upper") {
            EXPECT_NEAR(contact.area, pressed / weight, 1e-6);
          }
          expect_opposite(contact, 1e-9);
          expect_balance(step, 1e-7 * pressed);
        }
        EXPECT_EQ(
            std::ranges::count_if(report.warnings,
                                  [](const auto& w) { return w.text.find("no friction acts") != std::string::npos; }),
            0);
      }
    }
}

// Where the other body is prescribed to go along, as on a plane that stands for a symmetry, a pair stays a pair: halves
// of two blocks press and slip as the whole.
TEST(FrictionAtFixesOfBodies, HalvesByFixesAreLikeThoseBySymmetry) {
  const auto contact_of = [](bool half, const std::string& conditions) {
    const auto body = [&](const char* name, double width, double low, double high, int cells, double poisson) {
      return block(name, fmt::format("[{}, {}]", half ? 0 : -width, low), fmt::format("[{}, {}]", width, high),
                   fmt::format("[{}, {}]", half ? cells : 2 * cells, cells), material(1, poisson));
    };
    Driver driver(scene_of(body("lower", 1.5, 0, 1, 6, 0.3) + body("upper", 0.5, 1, 1.5, 2, 0.45) +
                           fix("lower", "bottom", "[0, 0]") + fix("upper", "top", "[\"free\", \"-0.05 * t\"]") +
                           pair("upper", "bottom", "lower", "top", "friction = 0.1\n", "elastic_coulomb") + conditions +
                           "[steps]\ncount = 2\n[refine]\nuniform = 1\n"));
    return driver.solve().last().contact[0];
  };
  const ContactReport half =
      contact_of(true, fix("lower", "left", "[0, \"free\"]") + fix("upper", "left", "[0, \"free\"]"));
  const ContactReport whole = contact_of(false, "[symmetry]\nx = 0\n");
  EXPECT_GT(half.slip_nodes, 2);
  EXPECT_NEAR(half.force[1], whole.force[1] / 2, 1e-7 * half.force[1]);
  EXPECT_EQ(half.slip_nodes, whole.slip_nodes);
}

// A quarter of two blocks by fixes, meshes that do not match: a node on a plane of symmetry sees of the other body what
// is beside that plane, too. It stays a pair, as the point in front of it goes along.
TEST(FrictionAtFixesOfBodies, QuartersByFixesTouchEverywhere) {
  const auto quarter = [](const char* name, double low, const std::string& cells, int order) {
    return block(name, fmt::format("[0, 0, {}]", low), fmt::format("[1, 1, {}]", low + 0.5), cells,
                 material(1, 0.3, order)) +
           fix(name, "left", "[0, \"free\", \"free\"]") + fix(name, "front", "[\"free\", 0, \"free\"]");
  };
  for (const int order : {1, 2})
    for (const char* slave : {"body", "other"}) {
      SCOPED_TRACE(fmt::format("order {}, slave {}", order, slave));
      Driver driver(scene_of(quarter("lower", 0, "[1, 3, 1]", order) + quarter("upper", 0.5, "[3, 1, 1]", order) +
                             fix("lower", "bottom", "[\"free\", \"free\", 0]") +
                             fix("upper", "top", "[\"free\", \"free\", -0.01]") +
                             pair("upper", "bottom", "lower", "top",
                                  fmt::format("friction = 0.3\nslave = \"{}\"\n", slave), "elastic_coulomb")));
      const Report& report = driver.solve();
      ASSERT_TRUE(report.converged()) << report.reason();
      const ContactReport& contact = report.last().contact[0];
      EXPECT_NEAR(contact.area, 1, 1e-6);
      EXPECT_NEAR(contact.force[2], 0.01, 1e-8);
      EXPECT_NEAR(contact.max_pressure, 0.01, 1e-8);
    }
}

}  // namespace
}  // namespace signorini::test
