// Where contact ends at an edge of one side, and where pressures peak at an edge or a tip of one.
#include <cmath>
#include <numbers>

#include "core/mesh/structured.hpp"
#include "tests/driver/warned.hpp"
#include "tests/verification/mesh_file.hpp"

namespace signorini::test {
namespace {

ContactReport contact(const std::string& text) {
  Driver driver(scene_of(text));
  EXPECT_TRUE(driver.solve().converged());
  return driver.report().last().contact.at(0);
}

/// Lengths, stresses and a turn of a plane scene.
struct Units {
  double length = 1, stress = 1, turn = 0;
  std::string at(double x, double y) const {
    return fmt::format("[{:.17g}, {:.17g}]", length * (std::cos(turn) * x - std::sin(turn) * y) + 7 * length,
                       length * (std::sin(turn) * x + std::cos(turn) * y));
  }
  std::string along(double x, double y) const {
    return fmt::format("[{:.17g}, {:.17g}]", std::cos(turn) * x - std::sin(turn) * y,
                       std::sin(turn) * x + std::cos(turn) * y);
  }
};

/// A foot with chamfers, on what follows.
std::string foot(double size, const Units& u, double push = 0.001) {
  return fmt::format(
      "[[body]]\nname = 'foot'\nshape = 'polygon'\npoints = [{}, {}, {}, {}, {}, {}]\nsize = {}\nyoung = {}\npoisson = "
      "0.3\n[[fix]]\nbody = 'foot'\non = 'edge4'\nframe = 'normal'\nvalue = [{}, 0]\n",
      u.at(-0.75, 0.1), u.at(-0.5, 0), u.at(0.5, 0), u.at(0.75, 0.1), u.at(0.75, 1), u.at(-0.75, 1), size * u.length,
      u.stress, -push * u.length);
}

std::string floor_below(const Units& u) {
  return fmt::format(
      "[[obstacle]]\ntype = 'contact'\nbody = 'foot'\non = 'boundary'\nshape = 'plane'\npoint = {}\n"
      "normal = {}\n",
      u.at(0, 0), u.along(0, 1));
}

TEST(ContactArea, EndsAtTheChamferOfAFoot) {
  for (const double size : {0.13, 0.07})
    for (const Units& u : {Units{}, Units{1000, 2e5, 0.5}, Units{1e-3, 1, -2}})
      EXPECT_NEAR(contact(foot(size, u) + floor_below(u)).area, u.length, 0.006 * u.length) << size;
}

TEST(ContactArea, EndsAtTheChamferOfARoundFoot) {
  for (const double size : {0.13, 0.07})
    EXPECT_NEAR(contact(fmt::format("[[body]]\nname = 'foot'\nshape = 'polygon'\npoints = [[0, 0], [0.5, 0], [0.75, "
                                    "0.1], [0.75, 1], [0, 1]]\nsize = {}\nyoung = 1\npoisson = 0.3\nplane = "
                                    "'axisymmetric'\n[[fix]]\nbody = 'foot'\non = 'edge3'\nvalue = [0, -0.001]\n",
                                    size) +
                        floor_below({}))
                    .area,
                std::numbers::pi / 4, 0.006)
        << size;
}

TEST(ContactArea, EndsAtTheChamferOfAFootOnABlock) {
  for (const double size : {0.13, 0.07})
    EXPECT_NEAR(contact(foot(size, {}) +
                        "[[body]]\nname = 'block'\nshape = 'rectangle'\nfrom = [5, -1]\nto = [9, 0]\ncells = [50, "
                        "12]\nyoung = 1\npoisson = 0.3\n[[fix]]\nbody = 'block'\non = 'bottom'\nvalue = [0, 0]\n"
                        "[[obstacle]]\ntype = 'elastic'\nbody = 'foot'\non = 'boundary'\nother = 'block'\nother_on = "
                        "'top'\nslave = 'body'\n")
                    .area,
                1, 0.01)
        << size;
}

/// A foot of two cells per chamfer or so on a block, either of them the slave.
ContactReport foot_on_block(const char* slave, int cells, int order) {
  return contact(foot(0.11, {}) +
                 fmt::format("[[body]]\nname = 'block'\nshape = 'rectangle'\nfrom = [5, -1]\nto = [9, "
                             "0]\ncells = [{0}, 8]\nyoung = 1\npoisson = 0.3\norder = {1}\n[[fix]]\nbody = 'block'\non "
                             "= 'bottom'\nvalue = [0, 0]\n[[obstacle]]\ntype = 'elastic'\nbody = 'foot'\non = "
                             "'boundary'\nother = 'block'\nother_on = 'top'\nslave = '{2}'\n",
                             cells, order, slave));
}

// An edge of the master lies within a face of the slave: what falls back behind it is not pressed, what is before it is
// to the end.
TEST(ContactForce, IsThatOfEitherSlaveAtAChamferOfTheMaster) {
  for (const int order : {1, 2})
    for (const int cells : {29, 33, 35, 37, 41, 46}) {
      const ContactReport as_slave = foot_on_block("body", cells, order);
      const ContactReport as_master = foot_on_block("other", cells, order);
      EXPECT_NEAR(as_master.force[1], as_slave.force[1], 0.025 * as_slave.force[1]) << cells << ' ' << order;
      EXPECT_NEAR(as_master.area, 1, order == 1 ? 1e-6 : 0.01) << cells << ' ' << order;
    }
}

/// The same in space: a square foot with chamfers all around.
ContactReport foot_in_space(const TemporaryFolder& folder, const char* slave, int cells) {
  Mesh<3> mesh = box({-0.75, -0.75, 0}, {0.75, 0.75, 1}, {12, 12, 6});
  for (Point<3>& x : mesh.points) {
    const double bottom = 0.4 * std::max({0.0, std::abs(x[0]) - 0.5, std::abs(x[1]) - 0.5});
    x[2] = bottom + (1 - bottom) * x[2];
  }
  return contact(fmt::format(
      "[[body]]\nname = 'foot'\nmesh = '{}'\nyoung = 1\npoisson = 0.3\norder = 1\n[[fix]]\nbody = 'foot'\non = 'top'\n"
      "value = [0, 0, -0.001]\n[[body]]\nname = 'block'\nshape = 'box'\nfrom = [-1.5, -1.5, -1]\nto = [1.5, 1.5, 0]\n"
      "cells = [{}, {}, 5]\nyoung = 1\npoisson = 0.3\norder = 1\n[[fix]]\nbody = 'block'\non = 'bottom'\nvalue = [0, "
      "0, "
      "0]\n[[obstacle]]\ntype = 'elastic'\nbody = 'foot'\non = 'bottom'\nother = 'block'\nother_on = 'top'\nslave = "
      "'{}'\n",
      folder.write("foot.msh", msh(mesh)), cells, cells, slave));
}

TEST(ContactForce, IsThatOfEitherSlaveAtChamfersInSpace) {
  const TemporaryFolder folder;
  for (const int cells : {11, 12, 13}) {
    const ContactReport as_slave = foot_in_space(folder, "body", cells);
    const ContactReport as_master = foot_in_space(folder, "other", cells);
    EXPECT_NEAR(as_master.force[2], as_slave.force[2], 0.04 * as_slave.force[2]) << cells;
    EXPECT_NEAR(as_master.area, 1, 0.01) << cells;
  }
}

/// A block on the top of a rib, which stands on a plate that the block overhangs.
ContactReport block_on_rib(const char* slave, int cells, double height, int order) {
  return contact(fmt::format(
      "[[body]]\nname = 'rib'\nshape = 'polygon'\npoints = [[-3, -2], [3, -2], [3, {0}], [1, {0}], [1, 0], [-1, 0], "
      "[-1, {0}], [-3, {0}]]\nsize = 0.25\nyoung = 1\npoisson = 0.3\norder = {3}\n[[body]]\nname = 'block'\nshape = "
      "'rectangle'\nfrom = [-2, 0]\nto = [2, 1]\ncells = [{1}, 4]\nyoung = 1\npoisson = 0.3\norder = {3}\n[[fix]]\n"
      "body = 'block'\non = 'top'\nvalue = [0, -0.001]\n[[fix]]\nbody = 'rib'\non = 'edge0'\nvalue = [0, 0]\n"
      "[[obstacle]]\ntype = 'elastic'\nbody = 'block'\non = 'bottom'\nother = 'rib'\nother_on = 'boundary'\nslave = "
      "'{2}'\n",
      -height, cells, slave, order));
}

// What the slave overhangs is no partner of it, however near behind what it lies on: that carries to its end, and is
// not pressed in.
TEST(ContactForce, IsThatOfEitherSlaveAtAStepOfTheMaster) {
  for (const int order : {1, 2})
    for (const double height : {0.005, 0.02, 0.3, 1.0}) {
      const ContactReport as_master = block_on_rib("other", 23, height, order);
      for (const int cells : {15, 16, 23, 46}) {
        const ContactReport as_slave = block_on_rib("body", cells, height, order);
        EXPECT_NEAR(as_slave.force[1], as_master.force[1], 0.025 * as_master.force[1]) << cells << ' ' << height;
        EXPECT_NEAR(as_slave.area, 2, 0.02) << cells << ' ' << height;
      }
    }
}

TEST(ContactArea, EndsAtTheChamferOfADieInSpace) {
  for (const int cells : {10, 14})
    EXPECT_NEAR(contact(fmt::format("[[body]]\nname = 'b'\nshape = 'box'\nfrom = [-1, 0, 0]\nto = [1, 0.5, 0.5]\ncells "
                                    "= [{0}, 3, 3]\nyoung = 1\npoisson = 0.3\norder = 1\n[[fix]]\nbody = 'b'\non = "
                                    "'top'\nvalue = [0, 0, -0.001]\n[[obstacle]]\ntype = 'contact'\nbody = 'b'\non = "
                                    "'bottom'\nshape = 'expression'\ndistance = 'max(z, z + 0.5 * (abs(x) - 0.55))'\n",
                                    cells))
                    .area,
                0.55, 0.006)
        << cells;
}

/// A block half of which rests on another body, all but rigid and the slave, and half on a rigid plane beside that.
std::string on_body_and_plane(int dimension, int order) {
  const bool plane = dimension == 2;
  return fmt::format(
      "[[body]]\nname = 'block'\nshape = '{0}'\nfrom = [-1, {1}0]\nto = [1, {2}1]\ncells = [8, {3}4]\nyoung = 1\n"
      "poisson = 0\norder = {4}\n[[body]]\nname = 'low'\nshape = '{0}'\nfrom = [-1, {1}-1]\nto = [0, {2}0]\ncells = "
      "[4, {3}4]\nyoung = 1e6\npoisson = 0\norder = {4}\n[[fix]]\nbody = 'block'\non = 'top'\nvalue = [0, {5}"
      "-0.001]\n[[fix]]\nbody = 'low'\non = 'bottom'\nvalue = [0, {1}0]\n[[obstacle]]\ntype = 'elastic'\nbody = "
      "'block'\non = 'bottom'\nother = 'low'\nother_on = 'top'\nslave = 'other'\n[[obstacle]]\ntype = 'contact'\n"
      "body = 'block'\nwhere = 'x > -1e-9 && {6} < 1e-9'\nshape = 'plane'\npoint = [0, {1}0]\nnormal = [0, {1}1]\n",
      plane ? "rectangle" : "box", plane ? "" : "0, ", plane ? "" : "1, ", plane ? "" : "3, ", order,
      plane ? "" : "0, ", plane ? "y" : "z");
}

TEST(ContactPressure, IsUniformWhereABodyAndAnObstacleMeet) {
  for (const int dimension : {2, 3})
    for (const int order : {1, 2}) {
      Driver driver(scene_of(on_body_and_plane(dimension, order)));
      EXPECT_TRUE(driver.solve().converged());
      const auto& found = driver.report().last().contact;
      EXPECT_NEAR(found.at(0).max_pressure, 1e-3, 1e-5) << dimension << ' ' << order;
      EXPECT_NEAR(found.at(1).max_pressure, 1e-3, 1e-5) << dimension << ' ' << order;
      EXPECT_NEAR(found.at(0).force[dimension - 1] + found.at(1).force[dimension - 1], 2e-3, 1e-7);
    }
}

/// The mesh resolves it, or not.
const auto tipped = testing::Contains(testing::AnyOf(
    HasSubstr("the largest pressure is where an edge or a corner touches"), HasSubstr("too few of them have contact")));

std::string pressed(const std::string& distance, double length = 1, double stress = 1) {
  return fmt::format(
      "[[body]]\nname = 'b'\nshape = 'rectangle'\nfrom = [{0}, 0]\nto = [{1}, {1}]\ncells = [60, 30]\nyoung = {2}\n"
      "poisson = 0.3\n[[fix]]\nbody = 'b'\non = 'top'\nvalue = [0, {3}]\n[[obstacle]]\ntype = 'contact'\nbody = 'b'\n"
      "on = 'bottom'\nshape = 'expression'\ndistance = '{4}'\n",
      -length, length, stress, -0.01 * length, distance);
}

TEST(ContactWarnings, OfKinksInWhatIsTouched) {
  EXPECT_THAT(warnings(pressed("y + 0.05 * abs(x)")), tipped);
  EXPECT_THAT(warnings(pressed("y + 0.05 * abs(x - 0.013)")), tipped);
  EXPECT_THAT(warnings(pressed("y + 0.05 * abs(x - 13)", 1000, 2e11)), tipped);
  for (const char* smooth : {"y + 0.1 * x^2", "y + 0.02 * (1 - cos(5 * x))", "sqrt(x^2 + (y + 5)^2) - 5"})
    EXPECT_THAT(warnings(pressed(smooth)), Not(tipped)) << smooth;
}

TEST(ContactWarnings, OfTheTipOfABodyThatPressesAnother) {
  const auto two = [](const char* points, const char* slave) {
    return warnings(std::string("[[body]]\nname = 'tip'\nshape = 'polygon'\npoints = ") + points +
                    "\nsize = 0.06\nyoung = 1\npoisson = 0.3\n[[fix]]\nbody = 'tip'\nwhere = 'y > 1 - 1e-9'\nvalue = "
                    "[0, -0.02]\n[[body]]\nname = 'block'\nshape = 'rectangle'\nfrom = [-1, -1]\nto = [1, 0]\ncells = "
                    "[50, 25]\nyoung = 1\npoisson = 0.3\n[[fix]]\nbody = 'block'\non = 'bottom'\nvalue = [0, 0]\n"
                    "[[obstacle]]\ntype = 'elastic'\nbody = 'tip'\non = 'boundary'\nother = 'block'\nother_on = "
                    "'top'\nslave = '" +
                    slave + "'\n");
  };
  for (const char* slave : {"body", "other"})
    EXPECT_THAT(two("[[0.01, 0], [0.8, 0.05], [0.8, 1], [-0.8, 1], [-0.8, 0.05]]", slave), tipped) << slave;
}

}  // namespace
}  // namespace signorini::test
