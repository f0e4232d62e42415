#include <gmock/gmock.h>

#include <numbers>

#include "tests/bodies/scenes.hpp"
#include "tests/bodies/sector.hpp"
#include "tests/support/folder.hpp"

// Parts of the boundary that move as rigid bodies do, by displacements, rotations, forces and torques.

namespace signorini::test {
namespace {

using std::numbers::pi;
using tables::block, tables::fix, tables::load, tables::plane, tables::probe;

std::string rigid(const std::string& body, const std::string& on, const std::string& keys) {
  return fmt::format("[[rigid]]\nbody = \"{}\"\non = \"{}\"\n{}", body, on, keys);
}

std::string refined(int uniform) { return fmt::format("[refine]\nuniform = {}\n", uniform); }
const std::string exactly = "[solver]\ntolerance = 1e-12\n";

Report solved(const std::string& text) {
  Driver driver(scene_of(text));
  driver.solve();
  EXPECT_TRUE(driver.report().converged()) << driver.report().reason();
  return driver.report();
}

struct Case {
  int dimension, order;
};

class RigidPart : public testing::TestWithParam<Case> {
 protected:
  int D() const { return GetParam().dimension; }
  int order() const { return GetParam().order; }
  std::string in(const char* plane, const char* space) const { return D() == 2 ? plane : space; }
  std::string bar(double poisson, const std::string& more = "") const {
    return D() == 2 ? block("bar", "[0, 0]", "[4, 1]", "[8, 2]", material(2, poisson, order()) + more)
                    : block("bar", "[0, 0, 0]", "[4, 1, 1]", "[8, 2, 2]", material(2, poisson, order()) + more);
  }
  /// A block on an inclined plane, whose lower half is held at one side.
  std::string block_on_plane() const {
    return D() == 2 ? block("block", "[0, 0]", "[1, 1]", "[4, 4]", material(1, 0.3, order())) +
                          plane("block", "bottom", "[0, 0]", "[0.1, 1]") +
                          "[[fix]]\nbody = \"block\"\nwhere = \"x == 0 && y <= 0.5\"\nvalue = [0, \"free\"]\n"
                    : block("block", "[0, 0, 0]", "[1, 1, 1]", "[2, 2, 4]", material(1, 0.3, order())) +
                          plane("block", "bottom", "[0, 0, 0]", "[0.1, 0.05, 1]") +
                          "[[fix]]\nbody = \"block\"\nwhere = \"x == 0 && z <= 0.5\"\nvalue = [0, 0, \"free\"]\n";
  }
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return fmt::format("In{}DOrder{}", info.param.dimension, info.param.order);
}

/// A vector as TOML.
std::string toml(const std::vector<double>& values) {
  std::string out;
  for (const double v : values) out += fmt::format("{}{:.17g}", out.empty() ? "[" : ", ", v);
  return out + "]";
}

// Under a moment alone the end turns by M L / (E I) and sinks by M L^2 / (2 E I): without contraction that is a
// quadratic function, which leaves the ends plane.
TEST_P(RigidPart, OfACantileverTurnsAsABeam) {
  if (order() == 1) GTEST_SKIP() << "linear elements bend too little";
  const double moment = 1e-3, inertia = 1.0 / 12, curvature = moment / (2 * inertia);
  const Report report =
      solved(bar(0) + fix("bar", "left", in("[0, 0]", "[0, 0, 0]")) +
             rigid("bar", "right", fmt::format("torque = {}\n", D() == 2 ? toml({moment}) : toml({0, -moment, 0}))) +
             refined(1) + exactly);
  const RigidReport& end = report.last().rigid[0];
  EXPECT_NEAR(end.displacement.back(), curvature * 8, 1e-10);
  EXPECT_NEAR(end.displacement.front(), 0, 1e-11);
  EXPECT_NEAR(std::abs(end.rotation[D() == 2 ? 0 : 1]), curvature * 4, 1e-10);
  for (int i = 0; i < D(); ++i) EXPECT_NEAR(end.point[i], i == 0 ? 4 : 0.5, 1e-14);
  EXPECT_NEAR(report.last().reactions[0].force.back(), 0, 1e-12);
}

// Pulled without contraction.
TEST_P(RigidPart, IsPulledByAForce) {
  const Report report = solved(bar(0) + fix("bar", "left", in("[0, 0]", "[0, 0, 0]")) +
                               rigid("bar", "right", fmt::format("force = {}\n", in("[0.01, 0]", "[0.01, 0, 0]"))) +
                               refined(1) + exactly);
  EXPECT_NEAR(report.last().rigid[0].displacement[0], 0.01 * 4 / 2, 1e-11);
  EXPECT_NEAR(report.last().rigid[0].force[0], 0.01, 0);
  EXPECT_NEAR(report.last().reactions[0].force[0], -0.01, 1e-11);
  expect_balance(report.last(), 1e-11);
}

// What a table prescribes is what a fix does, and takes as many cycles, and forces do, too: on an inclined plane, where
// contact is part of the answer.
TEST_P(RigidPart, MovedByForcesOrByDisplacementsIsTheSame) {
  const std::vector<double> shift = D() == 2 ? std::vector{0.01, -0.05} : std::vector{0.01, -0.005, -0.05},
                            turn = D() == 2 ? std::vector{0.02} : std::vector{0.02, -0.01, 0.03};
  const std::string about = in("point = [0.3, 1.2]\n", "point = [0.3, 0.4, 1.2]\n");
  const std::string at = in("[0.2, 0.3]", "[0.2, 0.3, 0.4]"),
                    ends = refined(2) + exactly + probe("inside", "block", at);
  const std::string by_fix =
      D() == 2 ? R"~(["0.01 - 0.02 * (y - 1.2)", "-0.05 + 0.02 * (x - 0.3)"])~"
               : R"~(["0.01 - 0.01 * (z - 1.2) - 0.03 * (y - 0.4)", "-0.005 + 0.03 * (x - 0.3) - 0.02 * (z - 1.2)",
                      "-0.05 + 0.02 * (y - 0.4) + 0.01 * (x - 0.3)"])~";
  const Report fixed = solved(block_on_plane() + fix("block", "top", by_fix) + ends);
  const Report moved = solved(
      block_on_plane() +
      rigid("block", "top", about + "displacement = " + toml(shift) + "\nrotation = " + toml(turn) + "\n") + ends);
  const RigidReport& of_moved = moved.last().rigid[0];
  const Report pushed = solved(
      block_on_plane() +
      rigid("block", "top", about + "force = " + toml(of_moved.force) + "\ntorque = " + toml(of_moved.torque) + "\n") +
      ends);
  const RigidReport& of_pushed = pushed.last().rigid[0];
  EXPECT_GT(moved.last().contact[0].nodes, 3);
  for (int i = 0; i < D(); ++i) {
    EXPECT_NEAR(moved.last().probes[0].value[i], fixed.last().probes[0].value[i], 1e-10);
    EXPECT_NEAR(pushed.last().probes[0].value[i], fixed.last().probes[0].value[i], 1e-8 * 0.05);
    EXPECT_NEAR(of_moved.force[i], fixed.last().reactions[1].force[i], 1e-10);
    EXPECT_NEAR(of_pushed.displacement[i], shift[i], 1e-8 * 0.05);
    EXPECT_EQ(of_moved.displacement[i], shift[i]);
  }
  for (std::size_t i = 0; i < turn.size(); ++i) EXPECT_NEAR(of_pushed.rotation[i], turn[i], 1e-8);
  for (const Report* report : {&moved, &pushed}) expect_balance(report->last(), 1e-10);
  const auto cycles = [](const Report& of) { return of.last().summary.iterations; };
  // What contact holds takes more cycles than what is held, with a rigid part or without.
  const Report loaded = solved(block_on_plane() + load("block", toml(of_moved.force), "top") + ends);
  const Report level =
      solved(block_on_plane() +
             rigid("block", "top",
                   about + in("displacement = [0.01, \"free\"]\n", "displacement = [0.01, -0.005, \"free\"]\n") +
                       "rotation = " + toml(turn) + "\nforce = " +
                       (D() == 2 ? toml({0, of_moved.force[1]}) : toml({0, 0, of_moved.force[2]})) + "\n") +
             ends);
  show("{}D order {}: fixed {} cycles, moved {}, level {}, pushed {}, without it {}\n", D(), order(), cycles(fixed),
       cycles(moved), cycles(level), cycles(pushed), cycles(loaded));
  EXPECT_NEAR(level.last().rigid[0].displacement.back(), -0.05, 1e-8 * 0.05);
  EXPECT_LE(cycles(moved), cycles(fixed) + 1);
  EXPECT_LE(cycles(level), cycles(fixed) + 3);
  EXPECT_LE(cycles(pushed), std::max(cycles(loaded), cycles(fixed)) + 3);
}

// A force elsewhere is the same force and its moment here.
TEST_P(RigidPart, MayBeMovedAtAnyPoint) {
  const std::string held = bar(0.3) + fix("bar", "left", in("[0, 0]", "[0, 0, 0]")) + refined(1) + exactly;
  const Report here =
      solved(held + rigid("bar", "right",
                          in("point = [4, 0.5]\nforce = [0.001, -0.002]\ntorque = [0.003]\n",
                             "point = [4, 0.5, 0.5]\nforce = [0, 0, -0.002]\ntorque = [0.001, 0.003, 0]\n")));
  // Lever (2, 1): torque about the far point is T + (x - far) x F.
  const Report there =
      solved(held + rigid("bar", "right",
                          in("point = [6, 1.5]\nforce = [0.001, -0.002]\ntorque = [0.008]\n",
                             "point = [6, 0.5, 0.5]\nforce = [0, 0, -0.002]\ntorque = [0.001, -0.001, 0]\n")));
  const RigidReport &a = here.last().rigid[0], &b = there.last().rigid[0];
  for (std::size_t i = 0; i < a.rotation.size(); ++i) EXPECT_NEAR(a.rotation[i], b.rotation[i], 1e-10);
  if (D() == 2) {
    EXPECT_NEAR(b.displacement[0], a.displacement[0] - a.rotation[0], 1e-10);
    EXPECT_NEAR(b.displacement[1], a.displacement[1] + 2 * a.rotation[0], 1e-10);
  } else {
    EXPECT_NEAR(b.displacement[2], a.displacement[2] - 2 * a.rotation[1], 1e-10);
    EXPECT_NEAR(b.displacement[1], a.displacement[1] + 2 * a.rotation[2], 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, RigidPart, testing::Values(Case{2, 1}, Case{2, 2}, Case{3, 1}, Case{3, 2}),
                         name_of);

// T L / (G J) with J = pi r^4 / 2.
TEST(RigidEnd, OfAShaftTurnsByItsTorque) {
  const double torque = 1e-3, shear = 1 / (2 * 1.3), expected = torque * 2 / (shear * pi / 2);
  const Report report = solved(
      "[[body]]\nname = \"shaft\"\nshape = \"cylinder\"\ncenter = [0, 0, 1]\nradius = 1\nheight = 2\nsize = 0.5\n" +
      material(1, 0.3, 2) + fix("shaft", "bottom", "[0, 0, 0]") +
      rigid("shaft", "top", fmt::format("torque = [0, 0, {}]\n", torque)) + refined(1));
  const RigidReport& top = report.last().rigid[0];
  show("turn {:.6g}, expected {:.6g}, {} cycles\n", top.rotation[2], expected, report.last().summary.iterations);
  EXPECT_NEAR(top.rotation[2], expected, 2e-3 * expected);
  for (const double u : top.displacement) EXPECT_NEAR(u, 0, 1e-3 * expected);
}

// Of revolution it moves along the axis.
TEST(RigidEnd, OfARodOfRevolutionIsPulled) {
  for (const int order : {1, 2}) {
    const Report report = solved(
        block("rod", "[0, 0]", "[0.5, 2]", "[3, 8]", material(2, 0, order) + "plane = \"axisymmetric\"\n") +
        fix("rod", "bottom", "[\"free\", 0]") + rigid("rod", "top", "force = [0, 0.01]\n") + refined(1) + exactly);
    const double area = pi / 4;
    EXPECT_NEAR(report.last().rigid[0].displacement[1], 0.01 * 2 / (2 * area), 1e-10);
    EXPECT_NEAR(report.last().reactions[0].force[1], -0.01, 1e-11);
  }
}

// A rigid cylinder on a half space sinks in by F (1 - nu^2) / (2 a E) (Sneddon 1965). All of its surface is rigid, and
// the block under it is the slave.
TEST(RigidBody, SinksInAsSneddonSays) {
  const double force = 0.01, expected = force * (1 - 0.09) / 2;
  const std::string m = "plane = \"axisymmetric\"\n";
  std::vector<double> off;
  for (const double size : {10.0, 20.0}) {
    const Report report = solved(
        fmt::format(
            "[[body]]\nname = \"block\"\nshape = \"rectangle\"\nfrom = [0, {0}]\nto = [{1}, 0]\ncells = [{2}, {2}]\n",
            -size, size, int(size)) +
        material(1, 0.3, 2) + m + block("punch", "[0, 0]", "[1, 1]", "[3, 3]", material(1, 0.3, 2) + m) +
        rigid("punch", "boundary", fmt::format("force = [0, {}]\n", -force)) + fix("block", "bottom", "[\"free\", 0]") +
        pair("punch", "bottom", "block", "top") + refined(3));
    const RigidReport& punch = report.last().rigid[0];
    EXPECT_EQ(report.last().contact[0].pair->slave, "block");
    EXPECT_NEAR(report.last().contact[0].force[1], force, 1e-8);
    off.push_back(-punch.displacement[1] / expected - 1);
    show("half space of {}: {:.4g} off, {} cycles\n", size, off.back(), report.last().summary.iterations);
  }
  // What a block is too stiff shrinks with its size.
  const double at_infinity = 2 * off[1] - off[0];
  EXPECT_LT(std::abs(at_infinity), 0.02);
  EXPECT_LT(std::abs(off[1]), 0.08);
}

// A wheel on the ground, loaded by its axle, which keeps from turning and from moving sideways.
class Wheel : public Folder {};
TEST_F(Wheel, StandsOnTheGround) {
  for (const int order : {1, 2}) {
    const Report report = solved(
        sector(folder_, "wheel", {.inner = 0.3, .outer = 1, .along_radius = 4, .around = 24, .y = 1},
               material(1, 0.3, order)) +
        plane("wheel", "outer", "[0, 0]", "[0, 1]") +
        rigid("wheel", "inner", "displacement = [0, \"free\"]\nrotation = [0]\nforce = [0, -0.01]\n") + refined(2));
    const RigidReport& axle = report.last().rigid[0];
    EXPECT_NEAR(report.last().contact[0].force[1], 0.01, 1e-9);
    EXPECT_LT(axle.displacement[1], 0);
    EXPECT_NEAR(axle.force[0], 0, 1e-4 * 0.01);
    EXPECT_NEAR(axle.torque[0], 0, 1e-3 * 0.01);
    EXPECT_NEAR(axle.point[1], 1, 1e-9);
    expect_balance(report.last(), 1e-9);
  }
}

// Steps: what depends on t.
TEST(RigidEnd, FollowsItsSteps) {
  const Report report =
      solved(block("bar", "[0, 0]", "[2, 1]", "[4, 2]", material(1, 0.3, 2)) + fix("bar", "left", "[0, 0]") +
             rigid("bar", "right", "force = [\"0.01 * t\", 0]\nrotation = [\"0.01 * t\"]\n") + "[steps]\ncount = 2\n" +
             exactly);
  const RigidReport &half = report.steps[0].rigid[0], &all = report.steps[1].rigid[0];
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(2 * half.displacement[i], all.displacement[i], 1e-10);
  EXPECT_NEAR(2 * half.torque[0], all.torque[0], 1e-10);
}

// A tied body hangs from it.
TEST(RigidBody, MayBeTied) {
  const std::string m = material(1, 0.3, 2);
  const Report report = solved(block("plate", "[0, 1]", "[1, 1.2]", "[3, 1]", m) +
                               block("rubber", "[0, 0]", "[1, 1]", "[4, 4]", m) + fix("rubber", "bottom", "[0, 0]") +
                               rigid("plate", "boundary", "force = [0.001, -0.01]\nrotation = [0]\n") +
                               pair("plate", "bottom", "rubber", "top", "", "tied") + refined(1) + exactly);
  const Report same = solved(block("rubber", "[0, 0]", "[1, 1]", "[4, 4]", m) + fix("rubber", "bottom", "[0, 0]") +
                             rigid("rubber", "top", "force = [0.001, -0.01]\nrotation = [0]\n") + refined(1) + exactly);
  EXPECT_EQ(report.last().contact[0].pair->slave, "rubber");
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(report.last().rigid[0].displacement[i], same.last().rigid[0].displacement[i], 1e-9);
  expect_balance(report.last(), 1e-10);
}

TEST(RigidEnd, IsRefusedWhereSomethingElseHolds) {
  const std::string bar = block("bar", "[0, 0]", "[2, 1]", "[4, 2]", material(1));
  expect_error(bar + fix("bar", "bottom", "[0, 0]") + rigid("bar", "right", "force = [0, 1]\n"), Exit::input,
               "prescribes the displacement at (2, 0)");
  expect_error(bar + fix("bar", "left", "[0, 0]") + plane("bar", "bottom", "[0, 0]", "[0, 1]") +
                   rigid("bar", "right", "force = [0, -1]\n"),
               Exit::input, "acts at (2, 0)");
  expect_error(bar + fix("bar", "left", "[0, 0]") + rigid("bar", "right", "") + rigid("bar", "top", ""), Exit::input,
               "moves the same node");
  expect_error(bar + rigid("bar", "right", "displacement = [0, 0]\nforce = [1, 0]\n"), Exit::input,
               "component 0 of 'displacement' is prescribed");
  expect_error(bar + rigid("bar", "right", "torque = [0, 0]\n"), Exit::input, "expected 1 component, found 2");
  expect_error(bar + rigid("bar", "right", "") + "[symmetry]\ny = 0.5\n", Exit::input, "not available with [symmetry]");
  expect_error(bar + rigid("bar", "right", "force = [0.1, 0]\n"), Exit::no_solution, "translation along (1, 0)");
}

// What keeps a rigid end of a body of revolution on its circles is what a fix there would exert.
TEST(RigidEnd, OfABodyOfRevolutionHoldsItAsAFixDoes) {
  for (const int order : {1, 2}) {
    const std::string ring =
        block("b", "[1, 0]", "[2, 1]", "[4, 2]", material(1000, 0.3, order) + "plane = \"axisymmetric\"\n") +
        fix("b", "bottom", "[0, 0]") + exactly;
    const StepReport fixed = solved(ring + fix("b", "top", "[0, -0.01]")).last(),
                     rigidly = solved(ring + rigid("b", "top", "displacement = [\"free\", -0.01]\n")).last();
    EXPECT_LT(fixed.reactions[1].force[0], -1);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(rigidly.rigid[0].force[i], fixed.reactions[1].force[i], 1e-8);
      EXPECT_NEAR(rigidly.balance[0].sum()[i], fixed.balance[0].sum()[i], 1e-8);
    }
  }
}

}  // namespace
}  // namespace signorini::test
