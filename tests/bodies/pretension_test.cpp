#include <gmock/gmock.h>

#include <numbers>

#include "tests/bodies/scenes.hpp"
#include "tests/support/folder.hpp"

// Bolts: a cut through the shank is closed by a force, and then keeps its length. Against the stiffness of bars.

namespace signorini::test {
namespace {

using std::numbers::pi;
using tables::block, tables::fix, tables::load, tables::probe;

const std::string exactly = "[solver]\ntolerance = 1e-12\n";
const std::string two_steps = "[steps]\ncount = 2\n", three_steps = "[steps]\ncount = 3\n";

std::string refined(int uniform) { return fmt::format("[refine]\nuniform = {}\n", uniform); }

std::string cut(const std::string& keys, const std::string& more = "") {
  return pair("upper", "bottom", "lower", "top", "pretension = " + keys + "\n" + more, "tied");
}

Report solved(const std::string& text) {
  Driver driver(scene_of(text));
  driver.solve();
  EXPECT_TRUE(driver.report().converged()) << driver.report().reason();
  return driver.report();
}

struct Case {
  int dimension, order;
  const char* slave;
};

class Bolt : public testing::TestWithParam<Case> {
 protected:
  int D() const { return GetParam().dimension; }
  int order() const { return GetParam().order; }
  std::string slave() const { return fmt::format("slave = \"{}\"\n", GetParam().slave); }
  std::string in(const char* plane, const char* space) const { return D() == 2 ? plane : space; }
  /// A bar of length 2 and area 1, cut at 0.75, with meshes that do not match.
  std::string bar(const std::string& more = "", double poisson = 0) const {
    const std::string m = material(2, poisson, order()) + more;
    if (D() == 2)
      return block("lower", "[0, 0]", "[1, 0.75]", "[3, 2]", m) + block("upper", "[0, 0.75]", "[1, 2]", "[4, 3]", m);
    return block("lower", "[0, 0, 0]", "[1, 1, 0.75]", "[3, 2, 2]", m) +
           block("upper", "[0, 0, 0.75]", "[1, 1, 2]", "[2, 3, 3]", m);
  }
  std::string held() const { return fix("lower", "bottom", in("[0, 0]", "[0, 0, 0]")); }
  std::string end(const char* along) const {
    return fix("upper", "top", D() == 2 ? fmt::format("[0, {}]", along) : fmt::format("[0, 0, {}]", along));
  }
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return fmt::format("In{}DOrder{}{}", info.param.dimension, info.param.order, info.param.slave);
}

// Between two walls the bar bears the force, and becomes shorter by F L / (E A).
TEST_P(Bolt, BetweenWallsIsShorterByItsStrain) {
  const Report report = solved(bar() + held() + end("0") + cut("0.01", slave()) + refined(1) + exactly);
  const ContactReport& contact = report.last().contact[0];
  ASSERT_TRUE(contact.bolt);
  EXPECT_NEAR(contact.bolt->force, 0.01, 1e-12);
  EXPECT_NEAR(contact.bolt->shortening, 0.01 * 2 / 2, 1e-11);
  EXPECT_FALSE(contact.bolt->locked);
  EXPECT_TRUE(contact.tied);
  EXPECT_NEAR(contact.force.back(), -0.01, 1e-11);  // on the upper part, downwards
  EXPECT_NEAR(contact.area, 1, 1e-12);
  EXPECT_NEAR(report.last().reactions[0].force.back(), -0.01, 1e-11);
  EXPECT_NEAR(report.last().reactions[1].force.back(), 0.01, 1e-11);
  expect_opposite(contact, 1e-10);
  expect_balance(report.last(), 1e-11);
}

// Once locked it is a bar: pulled by d at its end it bears E A d / L more.
TEST_P(Bolt, KeepsItsLengthOnceLocked) {
  const Report report = solved(bar() + held() + end("\"max(0, 2 * t - 1) * 0.005\"") + cut("0.01", slave()) +
                               two_steps + refined(1) + exactly);
  const BoltReport first = *report.steps[0].contact[0].bolt, second = *report.steps[1].contact[0].bolt;
  EXPECT_NEAR(first.force, 0.01, 1e-12);
  EXPECT_FALSE(first.locked);
  EXPECT_TRUE(second.locked);
  EXPECT_NEAR(second.shortening, first.shortening, 1e-15);
  EXPECT_NEAR(second.force, 0.01 + 2 * 0.005 / 2, 1e-11);
  EXPECT_NEAR(report.steps[1].contact[0].force.back(), -second.force, 1e-10);
  EXPECT_NEAR(report.steps[1].reactions[0].force.back(), -second.force, 1e-10);
  expect_opposite(report.last().contact[0], 1e-10);
  expect_balance(report.last(), 1e-11);
}

// When it is warmed between the walls it loses E A alpha T.
TEST_P(Bolt, LosesForceByHeat) {
  const Report report = solved(bar("expansion = 1e-3\ntemperature = \"max(0, 2 * t - 1) * 4\"\n") + held() + end("0") +
                               cut("0.01", slave()) + two_steps + refined(1) + exactly);
  EXPECT_NEAR(report.steps[0].contact[0].bolt->force, 0.01, 1e-12);
  // Walls hold it across, too, but without contraction that does nothing along it.
  EXPECT_NEAR(report.steps[1].contact[0].bolt->force, 0.01 - 2 * 4e-3, 1e-11);
}

// The force grows over two steps, and is kept after them.
TEST_P(Bolt, IsLockedWhereTheSceneSays) {
  const Report report = solved(bar() + held() + end("\"max(0, 3 * t - 2) * 0.005\"") +
                               cut("\"0.015 * t\"", "lock_at = 0.7\n" + slave()) + three_steps + exactly);
  EXPECT_NEAR(report.steps[0].contact[0].bolt->force, 0.005, 1e-12);
  EXPECT_NEAR(report.steps[1].contact[0].bolt->force, 0.01, 1e-12);
  EXPECT_FALSE(report.steps[1].contact[0].bolt->locked);
  EXPECT_NEAR(report.steps[2].contact[0].bolt->force, 0.015, 1e-11);
  EXPECT_TRUE(report.steps[2].contact[0].bolt->locked);
}

// With contraction the faces of the cut do not stay plane. The solver takes as many cycles as for a tie.
TEST_P(Bolt, TakesNoMoreCyclesThanATie) {
  const std::string text = bar("", 0.3) + held() + end("0") + refined(D() == 2 ? 3 : 2);
  const Report open = solved(text + cut("0.01", slave()));
  const Report tied = solved(text + load("upper", in("[0.001, -0.01]", "[0.001, 0, -0.01]")) +
                             pair("upper", "bottom", "lower", "top", slave(), "tied"));
  show("{}D order {} slave {}: {} cycles, tied {}\n", D(), order(), GetParam().slave, open.last().summary.iterations,
       tied.last().summary.iterations);
  EXPECT_NEAR(open.last().contact[0].bolt->force, 0.01, 1e-9);
  EXPECT_NEAR(open.last().reactions[1].force.back(), 0.01, 1e-7);
  EXPECT_LE(open.last().summary.iterations, tied.last().summary.iterations + 3);
}

INSTANTIATE_TEST_SUITE_P(Everywhere, Bolt,
                         testing::Values(Case{2, 1, "body"}, Case{2, 1, "other"}, Case{2, 2, "body"},
                                         Case{2, 2, "other"}, Case{3, 1, "body"}, Case{3, 1, "other"},
                                         Case{3, 2, "body"}, Case{3, 2, "other"}),
                         name_of);

/// A plate between the ground and a rigid head, which a bolt beside it clamps: stiffness 2 of the plate, 1 / 2 of the
/// bolt, forces per thickness. `outside` pulls at the head.
std::string joint(int order, const std::string& outside, const std::string& plate, const std::string& bolt,
                  const std::string& contact = "elastic", const std::string& more = "") {
  const std::string m = material(2, 0, order), b = material(1, 0, order);
  return block("plate", "[0, 0]", "[1, 1]", "[3, 3]", m) + block("lower", "[1.5, 0]", "[2, 0.4]", "[2, 2]", b) +
         block("upper", "[1.5, 0.4]", "[2, 1]", "[3, 2]", b) + block("head", "[-0.5, 1]", "[2.5, 1.3]", "[7, 1]", m) +
         fix("lower", "bottom", "[0, 0]") + plate +
         fmt::format(
             "[[rigid]]\nbody = \"head\"\non = \"boundary\"\npoint = [1, 1]\ndisplacement = [0, \"free\"]\n"
             "rotation = [0]\nforce = [0, {}]\n",
             outside) +
         pair("plate", "top", "head", "bottom", more, contact) + pair("upper", "top", "head", "bottom", "", "tied") +
         cut(bolt);
}

// The joint diagram: of an outer force P the bolt bears P k_b / (k_b + k_p), the rest relieves the plate, until the
// plate is free and the bolt bears all.
TEST(BoltedJoint, FollowsItsDiagram) {
  for (const int order : {1, 2}) {
    const Report report =
        solved(joint(order, "\"3 * max(0, t - 1 / 3) * 0.0075\"", fix("plate", "bottom", "[0, 0]"), "0.01") +
               three_steps + refined(2) + exactly);
    const auto bolt = [&](int step) { return *report.steps[step].contact[2].bolt; };
    const auto pressed = [&](int step) { return report.steps[step].contact[0].force[1]; };
    const double share = 0.5 / 2.5;
    EXPECT_NEAR(bolt(0).force, 0.01, 1e-11);
    EXPECT_NEAR(pressed(0), -0.01, 1e-10);
    EXPECT_NEAR(bolt(0).shortening, 0.01 / 0.5 + 0.01 / 2, 1e-10);
    EXPECT_NEAR(bolt(1).force, 0.01 + share * 0.0075, 1e-10);
    EXPECT_NEAR(pressed(1), -0.01 + (1 - share) * 0.0075, 1e-10);
    EXPECT_NEAR(bolt(2).force, 0.015, 1e-10);  // 0.008 would relieve the plate, of 0.015
    EXPECT_NEAR(pressed(2), 0, 1e-12);
    for (const StepReport& step : report.steps) expect_balance(step, 1e-10);
    show("joint of order {}: {} {} {} cycles\n", order, report.steps[0].summary.iterations,
         report.steps[1].summary.iterations, report.steps[2].summary.iterations);
  }
}

// A plate that is pushed out sideways is held by friction on both sides: 2 mu F.
TEST(BoltedJoint, HoldsThePlateByFriction) {
  const std::string ground =
      "[[obstacle]]\ntype = \"coulomb\"\nbody = \"plate\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\n"
      "normal = [0, 1]\nfriction = 0.2\n";
  const Report report = solved(joint(2, "0", fix("plate", "left", "[\"max(0, 2 * t - 1) * 0.1\", \"free\"]") + ground,
                                     "0.01", "elastic_coulomb", "friction = 0.3\n") +
                               two_steps + refined(2));
  EXPECT_NEAR(report.steps[1].contact[3].bolt->force, 0.01, 1e-5);
  EXPECT_NEAR(report.steps[1].reactions[1].force[0], 0.5 * 0.01, 1e-5);
}

// Of revolution the force is that on the whole shank.
TEST(RoundBolt, IsPulledAlongItsAxis) {
  for (const int order : {1, 2}) {
    const std::string m = material(2, 0, order) + "plane = \"axisymmetric\"\n";
    const Report report =
        solved(block("lower", "[0, 0]", "[0.5, 1]", "[2, 3]", m) + block("upper", "[0, 1]", "[0.5, 2]", "[3, 3]", m) +
               fix("lower", "bottom", "[0, 0]") + fix("upper", "top", "[0, 0]") + cut("0.01") + refined(1) + exactly);
    EXPECT_NEAR(report.last().contact[0].bolt->force, 0.01, 1e-12);
    EXPECT_NEAR(report.last().contact[0].bolt->shortening, 0.01 * 2 / (2 * pi / 4), 1e-10);
    EXPECT_NEAR(report.last().reactions[1].force[1], 0.01, 1e-11);
    expect_opposite(report.last().contact[0], 1e-10);
  }
}

// See apps/scenes/jobs/bolted_rings.toml.
TEST(RoundBolt, ClampsRingsAsByHand) {
  const std::vector<std::string> quiet{"solver.tolerance=1e-9"};
  Driver driver(read_scene(SIGNORINI_SOURCE_DIR "/apps/scenes/jobs/bolted_rings.toml", quiet));
  ASSERT_TRUE(driver.solve().converged()) << driver.report().reason();
  const double young = 210000, of_bolt = young * 25 * pi / 48, of_rings = young * (81 - 30.25) * pi / 40;
  const BoltReport first = *driver.report().steps[0].contact[0].bolt,
                   second = *driver.report().steps[1].contact[0].bolt;
  const double shortening = 20000 * (1 / of_bolt + 1 / of_rings), more = 7500 * of_bolt / (of_bolt + of_rings);
  show("shortening {:.4g}, by hand {:.4g}; force {:.5g} more, by hand {:.5g}; {} cycles\n", first.shortening,
       shortening, second.force - 20000, more, driver.report().last().summary.iterations);
  EXPECT_NEAR(first.force, 20000, 1e-6);
  EXPECT_NEAR(first.shortening, shortening, 0.02 * shortening);
  EXPECT_NEAR(second.force - 20000, more, 0.05 * more);
  EXPECT_EQ(second.shortening, first.shortening);
  EXPECT_NEAR(driver.report().last().contact[3].force[1], second.force - 15000, 1e-3);  // what is left of the clamping
}

// Half of it is pulled by half of the force.
TEST(HalfABolt, IsTheSameAsAllOfIt) {
  for (const int order : {1, 2}) {
    const std::string m = material(1, 0.3, order);
    const std::string text = block("lower", "[-1, 0]", "[1, 1]", "[4, 2]", m) +
                             block("upper", "[-1, 1]", "[1, 3]", "[4, 4]", m) + fix("lower", "bottom", "[0, 0]") +
                             fix("upper", "top", "[0, \"max(0, 2 * t - 1) * 0.01\"]") + cut("0.02") + two_steps +
                             refined(1) + exactly;
    const Report whole = solved(text), half = solved(text + "[symmetry]\nx = 0\n");
    for (int step = 0; step < 2; ++step) {
      const BoltReport &a = *whole.steps[step].contact[0].bolt, &b = *half.steps[step].contact[0].bolt;
      EXPECT_NEAR(a.force, b.force, 1e-4 * a.force);  // meshes are not symmetric
      EXPECT_NEAR(a.shortening, b.shortening, 1e-4 * a.shortening);
      EXPECT_NEAR(half.steps[step].reactions[1].force[1], b.force, 1e-10);
    }
    EXPECT_NEAR(half.steps[0].contact[0].bolt->force, 0.02, 1e-11);
  }
}

class TurnedBolt : public Folder {
 protected:
  /// A bar of area 1 along a direction in the plane, from one place along it to another.
  std::string bar(const std::string& name, double angle, double from, double to, int across, int along,
                  int order) const {
    std::string nodes, elements;
    int count = 0;
    const auto node = [&](int i, int j) { return 1 + i + j * (across + 1); };
    for (int j = 0; j <= along; ++j)
      for (int i = 0; i <= across; ++i) {
        const double x = double(i) / across, y = from + (to - from) * j / along;
        nodes += fmt::format("{} {:.17g} {:.17g} 0\n", node(i, j), std::cos(angle) * x - std::sin(angle) * y,
                             std::sin(angle) * x + std::cos(angle) * y);
      }
    for (int i = 0; i < across; ++i) {
      elements += fmt::format("{} 1 2 1 1 {} {}\n", ++count, node(i, 0), node(i + 1, 0));
      elements += fmt::format("{} 1 2 2 2 {} {}\n", ++count, node(i, along), node(i + 1, along));
    }
    for (int j = 0; j < along; ++j)
      for (int i = 0; i < across; ++i) {
        elements += fmt::format("{} 2 2 3 3 {} {} {}\n", ++count, node(i, j), node(i + 1, j), node(i + 1, j + 1));
        elements += fmt::format("{} 2 2 3 3 {} {} {}\n", ++count, node(i, j), node(i + 1, j + 1), node(i, j + 1));
      }
    std::ofstream(folder_ / (name + ".msh"))
        << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"bottom\"\n1 2 \"top\"\n2 3 \"inside\"\n"
           "$EndPhysicalNames\n$Nodes\n"
        << (across + 1) * (along + 1) << "\n"
        << nodes << "$EndNodes\n$Elements\n"
        << count << "\n"
        << elements << "$EndElements\n";
    return fmt::format("[[body]]\nname = \"{}\"\nmesh = \"{}\"\n{}", name, (folder_ / (name + ".msh")).string(),
                       material(2, 0.3, order));
  }
};

// However the axes lie.
TEST_F(TurnedBolt, IsTheSame) {
  for (const int order : {1, 2}) {
    std::vector<BoltReport> found;
    std::vector<int> cycles;
    for (const double angle : {0.0, 0.6, 2.0}) {
      const Report report = solved(bar("lower", angle, 0, 1, 3, 3, order) + bar("upper", angle, 1, 3, 4, 5, order) +
                                   fix("lower", "bottom", "[0, 0]") +
                                   fix("upper", "top",
                                       fmt::format("[\"{:.17g} * max(0, 2 * t - 1)\", \"{:.17g} * max(0, 2 * t - 1)\"]",
                                                   -0.01 * std::sin(angle), 0.01 * std::cos(angle))) +
                                   cut("0.02") + two_steps + refined(2) + exactly);
      for (const StepReport& step : report.steps) found.push_back(*step.contact[0].bolt);
      cycles.push_back(report.steps[0].summary.iterations);
      expect_opposite(report.last().contact[0], 1e-9);
      EXPECT_NEAR(length(report.last().reactions[1].force), found.back().force, 1e-3 * found.back().force);
    }
    for (std::size_t k = 2; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].force, found[k % 2].force, 1e-9 * found[k].force);
      EXPECT_NEAR(found[k].shortening, found[k % 2].shortening, 1e-9 * found[k].shortening);
    }
    EXPECT_NEAR(found[0].force, 0.02, 1e-11);
    show("order {}: {}\n", order, fmt::format("{}", fmt::join(cycles, " ")));
  }
}

// In newtons and millimetres, or in meganewtons and metres.
TEST(BoltedJoint, IsTheSameInOtherUnits) {
  const auto of = [](double length, double force) {
    const auto at = [&](double x, double y) { return fmt::format("[{:.17g}, {:.17g}]", x * length, y * length); };
    const std::string m = material(2e5 * force / (length * length), 0.3, 2);
    return solved(block("lower", at(0, 0), at(10, 20), "[3, 4]", m) +
                  block("upper", at(0, 20), at(10, 60), "[2, 8]", m) + fix("lower", "bottom", "[0, 0]") +
                  fix("upper", "top", "[0, 0]") + cut(fmt::format("{:.17g}", 1000 * force / length)) + refined(2));
  };
  const Report small = of(1, 1), large = of(1e-3, 1e-6);
  EXPECT_EQ(small.last().summary.iterations, large.last().summary.iterations);
  EXPECT_NEAR(large.last().contact[0].bolt->shortening, 1e-3 * small.last().contact[0].bolt->shortening,
              1e-9 * large.last().contact[0].bolt->shortening);
}

TEST(BoltedJoint, IsRefusedWhereItMeansNothing) {
  const std::string two = block("lower", "[0, 0]", "[1, 1]", "[2, 2]", material(1)) +
                          block("upper", "[0, 1]", "[1, 2]", "[3, 2]", material(1)) + fix("lower", "bottom", "[0, 0]") +
                          fix("upper", "top", "[0, 0]");
  expect_error(two + cut("-1"), Exit::input, "expected a number in (0, inf)");
  expect_error(two + cut("\"x\""), Exit::input, "depends on the place");
  expect_error(two + pair("upper", "bottom", "lower", "top", "pretension = 1\n", "elastic"), Exit::input,
               "expected type = 'tied', not 'elastic'");
  expect_error(two + pair("upper", "bottom", "lower", "top", "lock_at = 0.5\n", "tied"), Exit::input,
               "'lock_at' has no meaning without 'pretension'");
  expect_error(two + cut("1", "lock_at = 0.5\n"), Exit::input, "there is one step");
  expect_error(two + cut("1", "lock_at = 0.2\n") + two_steps, Exit::input, "0.2 is not within the steps");
  expect_error(two + cut("1") + "[solver]\nestimate = true\n", Exit::input, "bounds of the error are not available");
  expect_error(two + fix("upper", "left", "[\"free\", 0]") + cut("1", "slave = \"body\"\n"), Exit::input,
               "prescribes the displacement across the cut");
  expect_error(two + cut("1") + "[solver]\nbodies = \"dirichlet-neumann\"\n", Exit::input, "not available");
  const std::string of_revolution = material(1) + "plane = \"axisymmetric\"\n";
  expect_error(block("lower", "[1, 0]", "[2, 1]", "[2, 2]", of_revolution) +
                   block("upper", "[2, 0]", "[3, 1]", "[3, 2]", of_revolution) + fix("lower", "left", "[0, 0]") +
                   fix("upper", "right", "[0, 0]") +
                   pair("upper", "left", "lower", "right", "pretension = 1\n", "tied"),
               Exit::input, "pulled along its axis");
  const std::string bent = "\nother_where = \"y == 1 || x == 1\"\nwhere = \"y == 1 || x == 1\"\npretension = 1\n";
  expect_error(block("lower", "[0, 0]", "[1, 1]", "[2, 2]", material(1)) +
                   block("upper", "[0, 1]", "[1, 2]", "[3, 2]", material(1)) + fix("lower", "bottom", "[0, 0]") +
                   fix("upper", "top", "[0, 0]") +
                   "[[obstacle]]\ntype = \"tied\"\nbody = \"upper\"\nother = \"lower\"\nslave = \"body\"" + bent,
               Exit::input, "the cut is not flat");
  // Nothing holds what the bolt pulls.
  expect_error(block("lower", "[0, 0]", "[1, 1]", "[2, 2]", material(1)) +
                   block("upper", "[0, 1]", "[1, 2]", "[3, 2]", material(1)) + fix("lower", "bottom", "[0, 0]") +
                   cut("1"),
               Exit::no_solution, "translation along");
}

}  // namespace
}  // namespace signorini::test
