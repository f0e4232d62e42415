// Rigid obstacles past which a body is moved, or up to which: as if it were drawn where it comes to.
#include "core/fem/conditions/moved_on.hpp"

#include "core/fem/elements/nodes.hpp"
#include "core/fem/elements/symmetric_motion.hpp"
#include "driver/levels/slid.hpp"
#include "tests/bodies/scenes.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

using tables::block, tables::fix;

ContactReport contact_of(const std::string& text) {
  Driver driver(scene_of(text));
  EXPECT_TRUE(driver.solve().converged()) << driver.report().reason();
  return driver.report().last().contact[0];
}

/// A block on an obstacle, whose top moves by `by`.
std::string on_obstacle(const std::string& from, const std::string& to, const std::string& by,
                        const std::string& obstacle, const std::string& more) {
  return block("block", from, to, "[16, 8]", material(1000, 0.3, 2)) + fix("block", "top", by) +
         "[[obstacle]]\ntype = \"contact\"\nbody = \"block\"\non = \"bottom\"\n" + obstacle + more;
}

const std::string arch = "shape = \"expression\"\ndistance = \"y + 0.004 * (x - 1)^2\"\n";
const std::string disk = "shape = \"sphere\"\ncenter = [1, -5]\nradius = 5\n";
const std::string steps = "[steps]\ncount = 5\n";

// Seen from where the block was drawn the obstacle rises by more than it is pressed: the force was 3.2 times too large.
TEST(MovedObstacle, IsSeenFromWhereABodySlidesTo) {
  const ContactReport slid = contact_of(on_obstacle("[0, 0]", "[2, 1]", "[\"1.5 * t\", \"-0.01 * t\"]", arch, steps));
  const ContactReport drawn = contact_of(on_obstacle("[1.5, 0]", "[3.5, 1]", "[0, -0.01]", arch, ""));
  EXPECT_NEAR(slid.force[1], drawn.force[1], 0.01 * drawn.force[1]);
  EXPECT_NEAR(slid.area, drawn.area, 0.02 * drawn.area);
  EXPECT_NEAR(slid.max_pressure, drawn.max_pressure, 0.02 * drawn.max_pressure);
}

// Seen from a distance of a radius a disk is twice as wide.
TEST(MovedObstacle, IsSeenFromWhereABodyComesTo) {
  const ContactReport come = contact_of(on_obstacle("[0, 5]", "[2, 6]", "[0, \"-5.02 * t\"]", disk, steps));
  const ContactReport drawn = contact_of(on_obstacle("[0, 0]", "[2, 1]", "[0, -0.02]", disk, ""));
  EXPECT_NEAR(come.force[1], drawn.force[1], 0.01 * drawn.force[1]);
  EXPECT_NEAR(come.max_pressure, drawn.max_pressure, 0.02 * drawn.max_pressure);
}

// Without [steps] as well.
TEST(MovedObstacle, IsSeenFromThereInASingleStep) {
  const std::string by = "[1.5, -0.01]", at = "[0, 0]", to = "[2, 1]";
  const ContactReport slid = contact_of(on_obstacle(at, to, by, arch, ""));
  const ContactReport drawn = contact_of(on_obstacle("[1.5, 0]", "[3.5, 1]", "[0, -0.01]", arch, ""));
  EXPECT_NEAR(slid.force[1], drawn.force[1], 0.01 * drawn.force[1]);
  EXPECT_NEAR(slid.max_pressure, drawn.max_pressure, 0.01 * drawn.max_pressure);
  const ContactReport linear = contact_of(on_obstacle(at, to, by, arch + "renew = false\n", ""));
  EXPECT_GT(linear.force[1], 3 * drawn.force[1]);
}

/// A half disk that is moved down from `height` above where it touches the obstacle.
std::string lowered(double height, const std::string& obstacle, const std::string& more = "") {
  return fmt::format(
             "[[body]]\nname = \"disk\"\nshape = \"half_disk\"\ncenter = [0, {}]\nradius = 1\nsize = \"0.02 + 0.3 * "
             "sqrt(x^2 + (y - {})^2)\"\n",
             height, height - 1) +
         material(1, 0.3, 2) + fix("disk", "flat", fmt::format("[0, {}]", -height - 0.01)) +
         "[[obstacle]]\ntype = \"contact\"\nbody = \"disk\"\non = \"curved\"\n" + obstacle + more;
}

// From its centre all of a hollow circle is equally far, and linear conditions let the disk through it; ten radii above
// a disk touches with a single node, which flattens nothing.
TEST(MovedObstacle, IsFoundFromAfar) {
  const auto circle = [](double radius, bool inside) {
    return fmt::format("shape = \"sphere\"\ncenter = [0, {}]\nradius = {}\ninside = {}\n",
                       inside ? radius - 1 : -1 - radius, radius, inside);
  };
  for (const auto& [height, obstacle] : {std::pair(3.0, circle(3, true)), std::pair(10.0, circle(1, false))}) {
    const ContactReport come = contact_of(lowered(height, obstacle)), drawn = contact_of(lowered(0, obstacle));
    EXPECT_NEAR(come.force[1], drawn.force[1], 0.01 * drawn.force[1]);
    EXPECT_NEAR(come.max_pressure, drawn.max_pressure, 0.03 * drawn.max_pressure);
  }
}

// The half of a symmetric body does not move across the plane of symmetry as a whole.
TEST(MovedObstacle, IsSeenByAHalfAsByTheWhole) {
  const std::string obstacle = "shape = \"sphere\"\ncenter = [0, -3]\nradius = 2\n";
  const ContactReport whole = contact_of(lowered(2, obstacle)),
                      half = contact_of(lowered(2, obstacle, "[symmetry]\nx = 0\n"));
  EXPECT_NEAR(half.force[1], whole.force[1], 0.02 * whole.force[1]);
  EXPECT_NEAR(half.max_pressure, whole.max_pressure, 0.03 * whole.max_pressure);
  EXPECT_NEAR(half.depth, whole.depth, 0.3 * whole.depth);
}

// A flat body on a step of a hundredth of its way, which is half of what it is pressed in by: the force was twice too
// large.
TEST(MovedObstacle, IsSeenByFlatBodies) {
  const std::string ledge = "shape = \"expression\"\ndistance = \"y + 0.005 / (1 + exp(-20 * x))\"\n";
  const ContactReport come = contact_of(on_obstacle("[-2.5, 0]", "[-0.5, 0.5]", "[3.5, -0.01]", ledge, "")),
                      drawn = contact_of(on_obstacle("[1, 0]", "[3, 0.5]", "[0, -0.01]", ledge, ""));
  EXPECT_NEAR(come.force[1], drawn.force[1], 0.01 * drawn.force[1]);
}

// A coefficient is that of where the body was drawn; where it comes to it may mean nothing.
TEST(MovedObstacle, HasTheFrictionOfWhereTheBodyWasDrawn) {
  const auto friction = [](const std::string& coefficient) {
    std::string text = on_obstacle("[0, 0]", "[2, 1]", "[\"1.5 * t\", \"-0.01 * t\"]", arch,
                                   "friction = " + coefficient + "\n" + steps);
    return contact_of(text.replace(text.find("\"contact\""), 9, "\"coulomb\"")).force;
  };
  const std::vector<double> even = friction("0.2"), part = friction("\"0.2 * sqrt(2.001 - x) / sqrt(2.001 - x)\"");
  EXPECT_NEAR(part[0], even[0], 1e-6 * even[1]);
  EXPECT_LT(even[0], -0.1 * even[1]);
}

TEST(SymmetricMotion, StaysOnPlanesAndAxes) {
  Mesh<3> mesh;
  mesh.mirrors = {{0, 0.5}, {2, 0}};
  EXPECT_EQ(symmetric_motion<3>(mesh, Plane::strain, {1, 2, 3}), (Point<3>{0, 2, 0}));
  EXPECT_EQ(symmetric_motion<2>(Mesh<2>{}, Plane::axisymmetric, {1, 2}), (Point<2>{0, 2}));
  EXPECT_EQ(symmetric_motion<2>(Mesh<2>{}, Plane::stress, {1, 2}), (Point<2>{1, 2}));
}

// Half of what touches moves by a tenth of its width, the other body's half stays.
TEST(NoticeablySlid, IsInTwentiethsOfWhatTouches) {
  const Mesh<2> mesh = cube<2>(0, 1, 4);
  const Nodes<2> nodes(mesh);
  Model<2> model;
  model.obstacles.resize(1);
  ContactState<2> state;
  std::vector<ContactNode<2>> masters;
  std::vector<double> u(Offset{nodes.size()} * 2);
  for (Index p = 0; p < nodes.size(); ++p) {
    ContactNode<2> node{};
    node.vertex = p;
    node.contact = true;
    node.direction = {0, 1};
    if (nodes.at(p)[1] == 0) {
      state.nodes.push_back(node);
      u[Offset{p} * 2] = 0.1;
      u[Offset{p} * 2 + 1] = 7;
    } else if (nodes.at(p)[1] == 1) {
      masters.push_back(node);
    }
  }
  EXPECT_NEAR(noticeably_slid<2>(nodes, model, state, masters, u, {}), 2, 1e-12);
  EXPECT_NEAR(noticeably_slid<2>(nodes, model, state, masters, u, {{0.1, 0}}), 0, 1e-12);
  model.obstacles[0].tied = 0;
  EXPECT_EQ(noticeably_slid<2>(nodes, model, state, masters, u, {}), 0);
}

TEST(MovedOn, DoesNothingOnAPlane) {
  Model<2> model = resting_block<2>({0, -1e-6}, {});
  Mesh<2> mesh = cube<2>(0, 1, 4);
  const Nodes<2> nodes(mesh);
  std::vector<double> u;
  for (Index p = 0; p < nodes.size(); ++p) u.insert(u.end(), {5.0, -0.01});
  EXPECT_FALSE(moved_on(nodes, model, 0, u));
}

}  // namespace
}  // namespace signorini::test
