#include <gmock/gmock.h>

#include <numbers>

#include "tests/bodies/scenes.hpp"

// Blocks on each other: stacks, edges, partial overlap, and what cannot be.

namespace signorini::test {
namespace {

using std::numbers::pi;
using tables::block, tables::fix, tables::load;
using testing::HasSubstr;

// Each contact carries the weight of what is above it.
TEST(Stack, OfEightBlocksCarriesItsWeight) {
  constexpr int blocks = 8;
  constexpr double weight = 1e-3, width = 1, height = 0.5;
  std::string text;
  for (int k = 0; k < blocks; ++k) {
    const std::string name = fmt::format("b{}", k);
    const double shift = 0.03 * (k % 3), bottom = k * height;
    text += block(name, fmt::format("[{}, {}]", shift, bottom), fmt::format("[{}, {}]", shift + width, bottom + height),
                  fmt::format("[{}, {}]", 3 + k % 4, 2 + k % 2), material(k % 2 == 0 ? 1 : 4)) +
            load(name, fmt::format("[0, -{}]", weight)) + fix(name, "left", "[0, \"free\"]");
    if (k > 0) text += pair(name, "bottom", fmt::format("b{}", k - 1), "top");
  }
  Driver driver(scene_of(text + fix("b0", "bottom", "[\"free\", 0]") + "[refine]\nuniform = 2\n"));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  const StepReport& step = report.last();
  for (int k = 1; k < blocks; ++k) {
    const ContactReport& contact = step.contact[k - 1];
    EXPECT_NEAR(contact.force[1], (blocks - k) * weight * width * height, 1e-9 * weight);
    expect_opposite(contact);
    EXPECT_EQ(contact.pair->slave, fmt::format("b{}", k % 2 == 0 ? k : k - 1)) << "the softer one";
  }
  expect_balance(step, 1e-9 * weight);
  show("{} iterations\n", step.summary.iterations);
  EXPECT_LE(step.summary.iterations, 25);
}

// Friction alone holds them, and presses nowhere yet when the first cycle begins.
TEST(Stack, OfBlocksThatFrictionHoldsTakesFewCycles) {
  const std::string text = block("b0", "[-0.46, -0.5, 0]", "[0.54, 0.5, 0.4]", "[3, 4, 2]", material(0.1)) +
                           block("b1", "[-0.395, -0.395, 0.4]", "[0.395, 0.395, 0.8]", "[2, 2, 2]", material(2)) +
                           block("b2", "[-0.445, -0.465, 0.8]", "[0.485, 0.465, 1.2]", "[4, 3, 2]", material(7)) +
                           fix("b0", "bottom", "[0, 0, 0]") + load("b0", "[0, 0, -0.001]") +
                           load("b1", "[0, 0, -0.001]") + load("b2", "[0, 0, -0.001]") +
                           pair("b1", "bottom", "b0", "top", "friction = 0.3\n", "elastic_coulomb") +
                           pair("b2", "bottom", "b1", "top", "friction = 0.3\n", "elastic_coulomb");
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  EXPECT_EQ(report.last().summary.stages.size(), 1u);
  EXPECT_LE(report.last().summary.iterations, 30);
  EXPECT_NEAR(report.last().contact[1].force[2], 0.001 * 0.93 * 0.93 * 0.4, 1e-9);
}

// A tilted stack: what few cycles on coarse meshes leave has slid far away, and neither cycles nor Newton's method find
// back from there, or from zero.
TEST(Stack, OfSoftAndStiffBlocksIsFoundMeshByMesh) {
  std::string text = fix("b0", "bottom", "[0, 0]") + "[refine]\nuniform = 2\n";
  const double left[] = {0, 0.3, 0.1, 0.25}, young[] = {1, 100, 0.01, 10};
  const char* cells[] = {"[5, 2]", "[6, 3]", "[7, 2]", "[5, 3]"};
  for (int k = 0; k < 4; ++k) {
    const std::string name = fmt::format("b{}", k);
    text += block(name, fmt::format("[{}, {}]", left[k], 0.3 * k), fmt::format("[{}, {}]", left[k] + 1, 0.3 * (k + 1)),
                  cells[k], material(young[k])) +
            load(name, "[2e-8, -1e-6]");
    if (k > 0) text += pair(name, "bottom", fmt::format("b{}", k - 1), "top", "friction = 0.4\n", "elastic_coulomb");
  }
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(report.last().contact[k].force[0], -2e-8 * 0.3 * (3 - k), 1e-15);
    EXPECT_NEAR(report.last().contact[k].force[1], 1e-6 * 0.3 * (3 - k), 1e-13);
  }
  show("{} stages\n", report.last().summary.stages.size());
}

// Newton's method from zero finds what cycles slide away from.
TEST(Stiff, BlocksThatFrictionHoldsOnASoftBedAreSolved) {
  const std::string text = block("bed", "[0, 0]", "[2, 1]", "[6, 3]", material(1)) +
                           block("block", "[0.5, 1]", "[1.5, 1.5]", "[4, 2]", material(1e5)) +
                           fix("bed", "bottom", "[0, 0]") + load("block", "[0.000995, -0.00995]") +
                           pair("block", "bottom", "bed", "top", "friction = 0.3\n", "elastic_coulomb") +
                           "[refine]\nuniform = 2\n";
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  EXPECT_NEAR(report.last().contact[0].force[1], 0.00995 * 0.5, 1e-7);
}

/// What presses within `part` of half the width, as a part of the whole.
double force_within(const Driver& driver, double part) {
  return driver.visit(0, [&](const auto& run) {
    double inside = 0, all = 0;
    for (const auto& node : run.results().contact.nodes) {
      all += node.force[1];
      if (std::abs(run.nodes().at(node.vertex)[0]) < part) inside += node.force[1];
    }
    return inside / all;
  });
}

// The edges of a stiff block press into a soft one like those of a rigid punch: p = F / (pi sqrt(a^2 - x^2)). K. L.
// Johnson, Contact Mechanics, 1985, ch. 2.8. The edge of the master lies within faces of the slave.
TEST(Edges, OfAStiffBlockPressAsAPunchDoes) {
  std::vector<double> error;
  for (const int refinements : {1, 2, 3}) {
    const std::string text = block("soft", "[-10, -10]", "[10, 0]", "[41, 20]") +
                             block("stiff", "[-1, 0]", "[1, 1]", "[8, 4]", material(1e5)) +
                             fix("soft", "bottom", "[0, 0]") + fix("stiff", "top", "[0, -0.01]") +
                             pair("stiff", "bottom", "soft", "top") +
                             fmt::format("[refine]\nuniform = {}\n", refinements);
    Driver driver(scene_of(text));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    const ContactReport& contact = report.last().contact[0];
    EXPECT_EQ(contact.pair->slave, "soft");
    expect_opposite(contact);
    const double part = 0.7;
    error.push_back(std::abs(force_within(driver, part) - 2 / pi * std::asin(part)));
    show("{} iterations, force within 0.7 of the width off by {:.2e}\n", report.last().summary.iterations,
         error.back());
    EXPECT_LE(report.last().summary.iterations, 15);
  }
  EXPECT_LT(error.back(), 0.04);
  EXPECT_GT(std::log2(error.front() / error.back()) / 2, 1);
}

// Each hangs over the other one; which is the slave matters within the error of the mesh only.
TEST(Edges, HangOverBothWays) {
  std::vector<double> difference;
  for (const int refinements : {2, 3, 4}) {
    std::vector<double> force;
    for (const char* slave : {"body", "other"}) {
      Driver driver(scene_of(block("lower", "[0, 0]", "[1, 1]", "[5, 5]") +
                             block("upper", "[0.43, 1]", "[1.6, 1.7]", "[7, 4]") + fix("lower", "bottom", "[0, 0]") +
                             fix("upper", "top", "[0, -0.02]") +
                             pair("upper", "bottom", "lower", "top", fmt::format("slave = \"{}\"\n", slave)) +
                             fmt::format("[refine]\nuniform = {}\n", refinements)));
      const Report& report = driver.solve();
      ASSERT_TRUE(report.converged()) << report.reason();
      expect_opposite(report.last().contact[0]);
      expect_balance(report.last(), 1e-10);
      force.push_back(report.last().contact[0].force[1]);
    }
    difference.push_back(std::abs(force[0] - force[1]) / force[0]);
    show("forces {:.8g} {:.8g} differ by {:.2e}\n", force[0], force[1], difference.back());
  }
  EXPECT_LT(difference.back(), 1e-4);
  EXPECT_GT(std::log2(difference.front() / difference.back()) / 2, 1);
}

// A wedge that is moved along x by 0.02 on a slope of 30 degrees climbs, though its nodes are prescribed along x.
TEST(Wedge, ThatIsMovedClimbs) {
  const std::string rise = "0.57735026918962573";
  const auto polygon = [](const char* name, const std::string& points, double young) {
    return fmt::format("[[body]]\nname = \"{}\"\nshape = \"polygon\"\npoints = {}\nsize = 0.3\n{}", name, points,
                       material(young));
  };
  const std::string text =
      polygon("wedge", fmt::format("[[0, 0], [1, {}], [1, 1.2], [0, 1.2]]", rise), 1) +
      polygon("slope", fmt::format("[[-1, -2], [2, -2], [2, 1.1547005383792515], [-1, -{}]]", rise), 1e4) +
      fix("wedge", "boundary", "[0.02, \"free\"]") + fix("slope", "edge0", "[0, 0]") + load("wedge", "[0, -1e-6]");
  const std::string obstacle = pair("wedge", "edge0", "slope", "edge2", "slave = \"body\"\n");
  Driver driver(scene_of(text + obstacle));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  const ContactReport& contact = report.last().contact[0];
  EXPECT_NEAR(contact.displacement[1], 0.02 * std::sqrt(1.0 / 3), 1e-5);
  EXPECT_NEAR(contact.force[1], 1e-6 * (1.2 - 0.5 / std::sqrt(3)), 1e-10);
  expect_opposite(contact);
  expect_balance(report.last(), 1e-11);
  // What slips on the slope has no direction among what is free.
  expect_error(text + pair("wedge", "edge0", "slope", "edge2", "slave = \"body\"\nfriction = 0.1\n", "elastic_coulomb"),
               Exit::input, "neither along the slave's normal nor across it");
}

// The slave's nodes are moved along the other body: friction acts on neither, which the report does not hide.
/// Two blocks that an inclined interface divides, under a pressure of 0.01 on all sides but those that may slide along
/// a wall: two left or right ones, as told, and the bottom. The walls may have moved.
std::string divided(bool left_below, bool left_above, double moved, const std::string& keys) {
  const auto body = [&](const char* name, const char* points, double size) {
    return fmt::format("[[body]]\nname = \"{}\"\nshape = \"polygon\"\npoints = {}\nsize = {}\n", name, points, size) +
           material(1);
  };
  const auto push = [&](const std::string& name, const char* side, const char* value) {
    return fmt::format("[[load]]\nbody = \"{}\"\non = \"{}\"\nvalue = {}\n", name, side, value);
  };
  const auto sides = [&](const std::string& name, bool left, double wall) {
    return fix(name, left ? "edge3" : "edge1", fmt::format("[{}, \"free\"]", wall)) +
           push(name, left ? "edge1" : "edge3", left ? "[-0.01, 0]" : "[0.01, 0]");
  };
  return body("below", "[[0, 0], [1, 0], [1, 0.7], [0, 0.3]]", 0.2) +
         body("above", "[[0, 0.3], [1, 0.7], [1, 1.5], [0, 1.5]]", 0.13) + sides("below", left_below, 0) +
         sides("above", left_above, moved) + fix("below", "edge0", "[\"free\", 0]") +
         push("above", "edge2", "[0, -0.01]") + pair("above", "edge0", "below", "edge2", keys);
}

// What the master moves along what is prescribed at the slave's node counts, too.
TEST(Inclined, PatchTestBesideWalls) {
  for (const bool left_below : {true, false})
    for (const double moved : {0.0, 0.002})
      for (const char* slave : {"body", "other"}) {
        const std::string keys = fmt::format("slave = \"{}\"\n", slave);
        SCOPED_TRACE(keys + fmt::format("{} {}", left_below, moved));
        Driver driver(scene_of(divided(left_below, true, moved, keys) + "[refine]\nuniform = 1\n"));
        const Report& report = driver.solve();
        ASSERT_TRUE(report.converged()) << report.reason();
        const ContactReport& contact = report.last().contact[0];
        expect_opposite(contact);
        EXPECT_NEAR(contact.force[0], -0.004, 1e-9);
        EXPECT_NEAR(contact.force[1], 0.01, 1e-9);
        driver.visit(0, [&](const auto& run) {
          for (const auto& node : run.results().contact.nodes) EXPECT_NEAR(node.pressure, 0.01, 1e-9);
        });
      }
}

TEST(Slave, HasNoFrictionAlongWhatIsPrescribed) {
  Driver driver(
      scene_of(block("lower", "[0, 0]", "[2, 1]", "[8, 4]") + block("upper", "[0.5, 1]", "[1.5, 1.5]", "[4, 2]") +
               fix("lower", "bottom", "[0, 0]") + fix("upper", "bottom", "[0.01, \"free\"]") +
               fix("upper", "top", "[0.01, -0.01]") +
               pair("upper", "bottom", "lower", "top", "slave = \"body\"\nfriction = 0.3\n", "elastic_coulomb")));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  EXPECT_NEAR(report.last().contact[0].force[0], 0, 1e-12);
  EXPECT_GT(report.last().contact[0].force[1], 0);
  expect_opposite(report.last().contact[0]);
  expect_balance(report.last(), 1e-10);
}

/// A half disk on a block, whose slave the program chooses.
int iterations(double ratio, int refinements) {
  Driver driver(scene_of(fmt::format("[[body]]\nname = \"disk\"\nshape = \"half_disk\"\ncenter = [0, 1]\nradius = 1\n"
                                     "size = \"0.06 + 0.3 * sqrt(x^2 + y^2)\"\n{}[refine]\nuniform = {}\n",
                                     material(1), refinements) +
                         block("block", "[-2, -2]", "[2, 0]", "[32, 16]", material(ratio)) +
                         fix("disk", "flat", "[0, -0.02]") + fix("block", "bottom", "[0, 0]") +
                         pair("disk", "curved", "block", "top")));
  EXPECT_TRUE(driver.solve().converged());
  return driver.report().last().summary.iterations;
}

TEST(Stiffness, OfAnyRatioTakesAFewCycles) {
  std::vector<int> cycles;
  for (int k = 0; k <= 10; ++k) cycles.push_back(iterations(std::pow(10, -6 + 1.2 * k), 2));
  const auto [least, most] = std::ranges::minmax(cycles);
  show("{} to {} iterations\n", least, most);
  EXPECT_LE(most, 2 * least);
}

/// A block that lies on another one, 0.01 above it at the start.
std::string lying(const std::string& traction, const std::string& obstacle) {
  return block("below", "[0, 0]", "[2, 1]", "[8, 4]") + block("above", "[0.5, 1.01]", "[1.5, 1.5]", "[9, 5]") +
         fix("below", "bottom", "[0, 0]") + load("above", traction) + obstacle + "[refine]\nuniform = 2\n";
}

const std::string on_top = pair("above", "bottom", "below", "top"), away = pair("above", "bottom", "below", "bottom");

TEST(Unheld, BodiesAreNamed) {
  expect_error(lying("[0, 0.01]", on_top), Exit::no_solution, "translation along (0, 1) of the body 'above' around");
  expect_error(lying("[0.001, -0.01]", on_top), Exit::no_solution,
               "translation along (1, 0) of the body 'above' around");
  expect_error(lying("[0, -0.01]", away), Exit::no_solution, "translation along (0, -1) of the body 'above' around");
}

// No contact: a warning, and a linear solve.
TEST(Apart, BodiesAreSolvedOneByOne) {
  const std::string held = lying("[0, -0.01]", away) + fix("above", "left", "[0, 0]");
  Driver driver(scene_of(held));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("obstacle.0: no face of one body is in front of the other one's"));
  EXPECT_EQ(report.last().contact[0].nodes, 0);
  EXPECT_EQ(report.last().contact[0].force[1], 0);
  // Without the obstacle:
  Driver alone(scene_of(lying("[0, -0.01]", "") + fix("above", "left", "[0, 0]")));
  ASSERT_TRUE(alone.solve().converged());
  const std::vector<double> u = driver.solution(), expected = alone.solution(1);
  ASSERT_GT(u.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(u[u.size() - expected.size() + k], expected[k], 1e-7);
  show("{} iterations, one by one {}\n", report.last().summary.iterations, alone.report().last().summary.iterations);
}

// They face each other, and nothing brings them together.
TEST(Apart, BodiesAreNamedThatNeverTouch) {
  const auto moved = [](const char* by) {
    Driver driver(scene_of(lying("[0, 0]", on_top) + fix("above", "top", by)));
    return driver.solve();
  };
  const Report apart = moved("[0, -0.005]"), touching = moved("[0, -0.02]");
  ASSERT_EQ(apart.warnings.size(), 1u);
  EXPECT_THAT(apart.warnings[0], HasSubstr("obstacle.0: 'above' and 'below' never touch"));
  EXPECT_THAT(touching.warnings, testing::Not(testing::Contains(HasSubstr("never touch"))));
}

// Pressures grow at an edge that touches, on any mesh; where the contact itself has nodes enough that is what is said.
TEST(Edges, ThatTouchAreNotTakenForTooFewNodes) {
  const auto told = [](const std::string& uniform) {
    Driver driver(scene_of(block("below", "[0, 0]", "[1, 1]", "[4, 4]") +
                           block("above", "[0.2, 1]", "[1.2, 2]", "[7, 7]") + fix("below", "bottom", "[0, 0]") +
                           fix("above", "top", "[0, -0.01]") + pair("above", "bottom", "below", "top") +
                           "[refine]\nuniform = " + uniform + "\n"));
    const Report& report = driver.solve();
    EXPECT_TRUE(report.last().contact[0].resolved);
    return report.warnings;
  };
  for (const char* uniform : {"1", "2", "3"})
    EXPECT_THAT(told(uniform), testing::Not(testing::Contains(HasSubstr("too few")))) << uniform;
  EXPECT_THAT(told("3"), testing::Contains(HasSubstr("the largest pressure is where an edge or a corner touches")));
}

// A pin within one face of the slave: two nodes, and no pressure to speak of.
TEST(Edges, OfAPinOnOneFaceLeaveNothingResolved) {
  Driver driver(scene_of(block("lower", "[0, 0]", "[2, 1]", "[8, 4]") +
                         block("pin", "[1.05, 1]", "[1.1, 1.5]", "[1, 6]") + fix("lower", "bottom", "[0, 0]") +
                         fix("pin", "top", "[0, -0.01]") +
                         pair("pin", "bottom", "lower", "top", "slave = \"other\"\n") + "[refine]\nuniform = 1\n"));
  EXPECT_FALSE(driver.solve().last().contact[0].resolved);
}

// The vertex in the corner is deeper by the diagonal than along either wall, where less than an element is solved.
TEST(Corner, IsAsDeepAsItsWalls) {
  Driver driver(
      scene_of("[[body]]\nname = \"ell\"\nshape = \"polygon\"\npoints = [[0, 0], [3, 0], [3, 1], [1, 1], "
               "[1, 3], [0, 3]]\nsize = 0.2\n" +
               material(1) + block("block", "[0.85, 0.85]", "[2, 2]", "[5, 5]") +
               "[[fix]]\nbody = \"ell\"\nwhere = \"y == 0 || x == 0\"\nvalue = [0, 0]\n"
               "[[fix]]\nbody = \"block\"\nwhere = \"y == 2 || x == 2\"\nvalue = [-0.01, -0.01]\n" +
               pair("block", "boundary", "ell", "boundary")));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  EXPECT_NEAR(report.last().contact[0].force[0], report.last().contact[0].force[1], 0.05);
}

// Bodies at rest below one that is lifted off: nothing acts.
TEST(Apart, NothingActsOnBodiesThatAreLeftAlone) {
  Driver driver(scene_of(block("a", "[0, 0]", "[2, 1]", "[4, 2]") + block("b", "[0.2, 1]", "[1.8, 2]", "[5, 3]") +
                         block("c", "[0.4, 2]", "[1.6, 3]", "[4, 3]") + fix("a", "bottom", "[0, 0]") +
                         fix("b", "left", "[0, \"free\"]") + fix("b", "right", "[\"free\", 0]") +
                         fix("c", "top", "[0, 0.1]") + pair("b", "bottom", "a", "top") +
                         pair("c", "bottom", "b", "top") + "[refine]\nuniform = 1\n"));
  EXPECT_TRUE(driver.solve().converged()) << driver.report().reason();
  EXPECT_THAT(driver.report().warnings, testing::Not(testing::Contains(HasSubstr("forces balance"))));
}

TEST(Corner, BetweenTwoBodiesIsOneObstacle) {
  const std::string seat = block("seat", "[0, 0]", "[2, 1]", "[8, 4]") + block("wall", "[0, 1]", "[2, 2]", "[8, 4]") +
                           fix("seat", "bottom", "[0, 0]") + fix("wall", "top", "[0, -0.01]");
  expect_error(seat + pair("wall", "bottom", "seat", "top") + pair("wall", "bottom", "seat", "top"), Exit::input,
               "expected one obstacle with the faces of both");
}

TEST(Overlap, OfMoreThanAnElementIsNamed) {
  const auto overlapping = [](double by) {
    return block("below", "[0, 0]", "[2, 1]", "[8, 4]") +
           block("above", fmt::format("[0.5, {}]", 1 - by), "[1.5, 1.5]", "[4, 4]") + fix("below", "bottom", "[0, 0]") +
           fix("above", "top", "[0, 0]") + on_top;
  };
  for (const char* refined : {"", "[refine]\nuniform = 2\n"}) {
    Driver driver(scene_of(overlapping(0.2) + refined));  // elements are 0.25 long
    ASSERT_TRUE(driver.solve().converged());
    EXPECT_GT(driver.report().last().contact[0].force[1], 0);
    expect_error(overlapping(0.3) + refined, Exit::input, "the bodies overlap at the start, by 0.3 at (");
  }
  expect_error(overlapping(0.3), Exit::input, "the bodies overlap at the start, by 0.3 at (");
  expect_error(overlapping(0.3), Exit::input, ", 0.7)");
}

// Blocks that overlap by 0.3, free to widen: a uniform pressure shortens both, as an interference fit does.
TEST(Overlap, IsPressedApartWhereTheSceneSaysSo) {
  const std::string blocks = block("lower", "[0, 0]", "[1, 1]", "[8, 8]") +
                             block("upper", "[0, 0.7]", "[1, 1.5]", "[7, 6]") +
                             fix("lower", "bottom", "[\"free\", 0]") + fix("lower", "left", "[0, \"free\"]") +
                             fix("upper", "top", "[\"free\", 0]") + fix("upper", "left", "[0, \"free\"]");
  const double pressure = 0.3 / ((1 - 0.3 * 0.3) * (1 + 0.8));
  expect_error(blocks + pair("upper", "bottom", "lower", "top"), Exit::input, "resolve = true");
  for (const char* slave : {"body", "other"}) {
    Driver driver(scene_of(
        blocks + pair("upper", "bottom", "lower", "top", fmt::format("resolve = true\nslave = \"{}\"\n", slave))));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    const ContactReport& contact = report.last().contact[0];
    EXPECT_NEAR(contact.force[1], pressure, 1e-9);
    EXPECT_NEAR(contact.max_pressure, pressure, 1e-8);
    EXPECT_NEAR(contact.largest_penetration, 0, 1e-9);
    EXPECT_NEAR(contact.penetration_between_nodes, 0, 1e-9);
    expect_opposite(contact);
    expect_balance(report.last(), 1e-9);
  }
}

TEST(Overlap, IsAKeyOfPairs) {
  expect_error(block("a", "[0, 0]", "[1, 1]", "[2, 2]") + fix("a", "top", "[0, 0]") +
                   tables::plane("a", "bottom", "[0, 0]", "[0, 1]") + "resolve = true\n",
               Exit::input, "'resolve' has no meaning without 'other'");
}

// All of the boundary on both sides: faces on the far side do not see each other through the bodies.
TEST(Overlap, IsNotSeenThroughBodies) {
  Driver driver(scene_of(block("below", "[0, 0]", "[2, 1]", "[8, 4]") +
                         block("above", "[0.5, 1]", "[1.5, 1.5]", "[4, 4]") + fix("below", "bottom", "[0, 0]") +
                         fix("above", "top", "[0, -0.01]") + pair("above", "boundary", "below", "boundary")));
  ASSERT_TRUE(driver.solve().converged());
  EXPECT_GT(driver.report().last().contact[0].force[1], 0);
}

// Two blocks, the upper one this deep in the lower one, pressed on each other.
std::string interference(double by, const std::string& on, const std::string& more = "") {
  return block("below", "[0, 0]", "[1, 1]", "[4, 4]") +
         block("above", fmt::format("[0.1, {}]", 1 - by), fmt::format("[0.9, {}]", 2 - by), "[5, 6]") +
         fix("below", "bottom", "[0, 0]") + fix("above", "top", "[0, -0.02]") +
         pair("above", on, "below", "boundary", more);
}

double force_of(const std::string& text) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  return report.last().contact[0].force.back();
}

// Faces beside the overlap look across the bodies at those on the far side: these are no part of it.
TEST(Overlap, OfWholeBoundariesIsThatOfTheFacesThatMeet) {
  for (const double by : {1e-14, 0.05})
    for (const char* more : {"", "pairing = \"closest\"\n", "slave = \"other\"\n", "resolve = true\n",
                             "resolve = true\nslave = \"other\"\n"})
      EXPECT_NEAR(force_of(interference(by, "boundary", more)), force_of(interference(by, "bottom", more)), 1e-8)
          << by << ' ' << more;
  const auto in_space = [](const char* on) {
    return block("below", "[0, 0, 0]", "[1, 1, 1]", "[3, 3, 3]") +
           block("above", "[0.1, 0.1, 0.9999999999]", "[0.9, 0.9, 2]", "[2, 2, 2]") +
           fix("below", "bottom", "[0, 0, 0]") + fix("above", "top", "[0, 0, -0.02]") +
           pair("above", on, "below", "boundary");
  };
  EXPECT_NEAR(force_of(in_space("boundary")), force_of(in_space("bottom")), 1e-9);
}

TEST(Overlap, HasTheDepthToTheNearestFace) {
  const std::string blocks = block("below", "[0, 0]", "[2, 1]", "[8, 4]") + fix("below", "bottom", "[0, 0]") +
                             block("above", "[0.6, 0.6]", "[1.4, 1.6]", "[4, 4]") + fix("above", "top", "[0, 0]");
  for (const char* pairing : {"normal", "closest"}) {
    const std::string more = fmt::format("pairing = \"{}\"\n", pairing);
    for (const char* other_on : {"boundary", "top"})
      expect_error(blocks + pair("above", "boundary", "below", other_on, more), Exit::input, "by 0.4 at (");
    expect_error(blocks + pair("above", "boundary", "below", "boundary", more), Exit::input, ", 0.6)");
  }
}

// What the obstacle adds to the distance counts.
TEST(Overlap, IsWhatTheGapLeavesOfIt) {
  EXPECT_NEAR(force_of(interference(0.4, "bottom", "gap = 0.4\n")), force_of(interference(0, "bottom")), 1e-9);
  EXPECT_GT(force_of(interference(0.4, "bottom", "gap = \"0.38+0.01*x\"\n")), 0);
  expect_error(interference(0.4, "bottom", "gap = 0.1\n"), Exit::input, "overlap at the start, by 0.3 at (");
  expect_error(interference(0, "bottom", "gap = -5\n"), Exit::input, "overlap at the start, by 5 at (");
  EXPECT_GT(force_of(interference(0, "bottom", "gap = -0.3\nresolve = true\n")), 0);
}

TEST(Overlap, BetweenNodesCountsTheGap) {
  const auto depth = [](double by, const std::string& more) {
    Driver driver(scene_of(interference(by, "bottom", more)));
    return driver.solve().last().contact[0].penetration_between_nodes;
  };
  EXPECT_GT(depth(0, ""), 1e-5);
  EXPECT_NEAR(depth(0, "gap = -0.01\n"), depth(0.01, ""), 0.02 * depth(0.01, ""));
  EXPECT_NEAR(depth(0.01, "gap = 0.01\n"), depth(0, ""), 0.02 * depth(0, ""));
  EXPECT_GT(depth(0, "gap = \"0.01*x^2\"\n"), 1e-5);
}

}  // namespace
}  // namespace signorini::test
