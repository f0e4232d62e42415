#include <numbers>
#include <vector>

#include "core/mesh/simplex.hpp"
#include "tests/bodies/scenes.hpp"

// Bodies of quadratic elements in contact with each other.

namespace signorini::test {
namespace {

using std::numbers::pi;

/// Two blocks between a support and a pressure, 0.1 on the upper one, or on the face where they touch: each may slide
/// along x (and y) but for its left (front) face, so that the stress is uniaxial everywhere.
struct Press {
  int dimension;
  std::string upper, lower;  ///< cells
  double narrower = 0;       ///< the upper one ends that much before the lower one
  std::string material = "order = 2\nyoung = 1\npoisson = 0.3\n";
  std::string more = "slave = \"body\"\n";
};

std::string text_of(const Press& p) {
  using tables::block, tables::fix, tables::load;
  const double right = 1 - p.narrower;
  if (p.dimension == 2)
    return block("lower", "[0, 0]", "[1, 1]", p.lower, p.material) +
           block("upper", "[0, 1]", fmt::format("[{}, 1.75]", right), p.upper, p.material) +
           fix("lower", "bottom", "[\"free\", 0]") + fix("lower", "left", "[0, \"free\"]") +
           fix("upper", "left", "[0, \"free\"]") + load("upper", "[0, -0.1]", "top") +
           pair("upper", "bottom", "lower", "top", p.more);
  return block("lower", "[0, 0, 0]", "[1, 1, 1]", p.lower, p.material) +
         block("upper", "[0, 0, 1]", fmt::format("[{}, 1, 1.5]", right), p.upper, p.material) +
         fix("lower", "bottom", "[\"free\", \"free\", 0]") + fix("lower", "left", "[0, \"free\", \"free\"]") +
         fix("upper", "left", "[0, \"free\", \"free\"]") + fix("lower", "front", "[\"free\", 0, \"free\"]") +
         fix("upper", "front", "[\"free\", 0, \"free\"]") + load("upper", "[0, 0, -0.1]", "top") +
         pair("upper", "bottom", "lower", "top", p.more);
}

/// @param left of the balance of forces, which the pressure of incompressible material approaches by cycles
void expect_uniform_pressure(const std::string& text, double left = 1e-11) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  const double off = driver.visit(0, [&](const auto& run) {
    double worst = 0;
    for (const auto& node : run.results().contact.nodes) worst = std::max(worst, std::abs(node.pressure / 0.1 - 1));
    return worst;
  });
  EXPECT_LT(off, 1e-9);
  expect_opposite(report.last().contact[0]);
  expect_balance(report.last(), left);
  show("{} iterations, pressure off by {:.2e}\n", report.last().summary.iterations, off);
}

TEST(QuadraticBodies, PassThePatchTestIn2D) {
  for (const char* slave : {"slave = \"body\"\n", "slave = \"other\"\n"})
    for (const char* cells : {"[4, 3]", "[5, 3]", "[29, 3]", "[1, 1]"}) {
      SCOPED_TRACE(fmt::format("{} {}", slave, cells));
      expect_uniform_pressure(text_of({.dimension = 2, .upper = cells, .lower = "[4, 4]", .more = slave}));
    }
}

// Corners on the axis stand for nothing, and what is near it for little.
TEST(QuadraticBodies, PassThePatchTestOnAnAxis) {
  for (const char* slave : {"slave = \"body\"\n", "slave = \"other\"\n"})
    for (const char* cells : {"[4, 3]", "[9, 3]", "[33, 3]", "[1, 1]"}) {
      SCOPED_TRACE(fmt::format("{} {}", slave, cells));
      const std::string material = "plane = \"axisymmetric\"\norder = 2\nyoung = 1\npoisson = 0.3\n";
      expect_uniform_pressure(tables::block("lower", "[0, 0]", "[1, 1]", "[16, 3]", material) +
                                  tables::block("upper", "[0, 1]", "[1, 1.75]", cells, material) +
                                  tables::fix("lower", "bottom", "[\"free\", 0]") +
                                  tables::load("upper", "[0, -0.1]", "top") +
                                  pair("upper", "bottom", "lower", "top", slave) + "[solver]\ntolerance = 1e-11\n",
                              1e-10);
    }
}

TEST(QuadraticBodies, PassThePatchTestIn3D) {
  for (const char* slave : {"slave = \"body\"\n", "slave = \"other\"\n"})
    for (const char* cells : {"[2, 2, 1]", "[3, 5, 1]"}) {
      SCOPED_TRACE(fmt::format("{} {}", slave, cells));
      expect_uniform_pressure(text_of({.dimension = 3, .upper = cells, .lower = "[2, 2, 1]", .more = slave}));
    }
}

/// A block under its own pressure beside a part of the lower one that is free: the lower one is pressed by a load where
/// the upper one is not, so that its stress is uniaxial, too. Whoever is the slave overhangs or is overhung.
std::string overhang(double end, const char* slave, int cells) {
  const std::string material = "order = 2\nyoung = 1\npoisson = 0\n";
  return tables::block("lower", "[0, 0]", "[1, 1]", fmt::format("[{}, 3]", cells), material) +
         tables::block("upper", "[0, 1]", fmt::format("[{}, 1.5]", end), "[4, 2]", material) +
         tables::fix("lower", "bottom", "[0, 0]") + tables::fix("upper", "left", "[0, \"free\"]") +
         tables::load("upper", "[0, -0.1]", "top") + pair("upper", "bottom", "lower", "top", slave);
}

// Little or much of the last face is covered: forces balance, moments as well, and no node is pulled.
TEST(QuadraticBodies, BalanceWhereOneOverhangsTheOther) {
  for (const char* slave : {"slave = \"body\"\n", "slave = \"other\"\n"})
    for (const double end : {0.95, 0.8, 0.77, 0.7}) {
      SCOPED_TRACE(fmt::format("{} {}", slave, end));
      Driver driver(scene_of(overhang(end, slave, 4)));
      const Report& report = driver.solve();
      ASSERT_TRUE(report.converged()) << report.reason();
      const ContactReport& contact = report.last().contact[0];
      expect_opposite(contact);
      EXPECT_NEAR(length(contact.force), 0.1 * end, 1e-10);
      EXPECT_NEAR(contact.moment[0] + contact.pair->moment[0], 0, 1e-10);
      EXPECT_NEAR(contact.area, end, 0.02 * end);
      expect_balance(report.last(), 1e-10);
      show("force {:.4g}, largest pressure {:.4g}, {} iterations\n", length(contact.force), contact.max_pressure,
           report.last().summary.iterations);
    }
}

struct Found {
  double force = 0, width = 0, pressure = 0;  ///< the latter two over those of Hertz, less one
  int iterations = 0;
};

double modulus(double young, double poisson) { return young / (1 - poisson * poisson); }

Found found(const std::string& text, int dimension, double modulus, double curvature) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  const ContactReport& contact = report.last().contact[0];
  expect_opposite(contact);
  const double force = length(contact.force);
  const double width = dimension == 2 ? std::sqrt(4 * force / (pi * modulus * curvature))
                                      : std::cbrt(3 * force / (4 * modulus * curvature));
  const double pressure = dimension == 2 ? 2 * force / (pi * width) : 3 * force / (2 * pi * width * width);
  const Found out{force, contact.radius / width - 1, contact.max_pressure / pressure - 1,
                  report.last().summary.iterations};
  show("{} unknowns, force {:.6g}, width off by {:.2e}, pressure by {:.2e}, {} iterations\n",
       report.last().summary.level_unknowns.back(), out.force, out.width, out.pressure, out.iterations);
  return out;
}

/// Half a round body on another round one.
std::string round_bodies(int dimension, int order, int refinements, double approach) {
  const bool plane = dimension == 2;
  const auto body = [&](const char* name, const std::string& shape, const char* middle) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nshape = \"{}\"\ncenter = {}\nradius = 1\norder = {}\nsize = \"{} + 0.3 * "
        "sqrt(x^2 + y^2{})\"\nyoung = 1\npoisson = 0.3\n",
        name, shape, middle, order, plane ? 0.01 : 0.06, plane ? "" : " + z^2");
  };
  const std::string up = plane ? "y" : "z";
  return body("upper", plane ? "half_disk" : "half_ball", plane ? "[0, 1]" : "[0, 0, 1]") +
         body("lower", plane ? "disk" : "ball", plane ? "[0, -1]" : "[0, 0, -1]") +
         tables::fix("upper", "flat",
                     plane ? fmt::format("[0, {}]", -approach) : fmt::format("[0, 0, {}]", -approach)) +
         fmt::format("[[fix]]\nbody = \"lower\"\nwhere = \"{} < -1\"\nvalue = {}\n", up,
                     plane ? "[0, 0]" : "[0, 0, 0]") +
         fmt::format(
             "[[obstacle]]\ntype = \"elastic\"\nbody = \"upper\"\non = \"curved\"\nother = \"lower\"\n"
             "other_where = \"{} > -0.5\"\n[refine]\nuniform = {}\n",
             up, refinements);
}

// K. L. Johnson, Contact Mechanics, Cambridge 1985, ch. 4. Quadratic elements beside linear ones with as many unknowns.
void expect_hertz(int dimension, int refinements, double approach) {
  const double both = modulus(1, 0.3) / 2;
  Found linear, quadratic;
  for (int k = refinements - 1; k <= refinements; ++k) {
    linear = found(round_bodies(dimension, 1, k, approach), dimension, both, 2);
    quadratic = found(round_bodies(dimension, 2, k - 1, approach), dimension, both, 2);
    EXPECT_LE(quadratic.iterations, 1.5 * linear.iterations);
    EXPECT_LT(std::abs(quadratic.pressure), std::abs(linear.pressure));
  }
  EXPECT_LT(std::abs(quadratic.width), 0.03);
  EXPECT_LT(std::abs(quadratic.pressure), 0.005);
}

TEST(QuadraticBodies, PressAsHertzSaysIn2D) { expect_hertz(2, 3, 0.004); }
TEST(QuadraticBodies, PressAsHertzSaysIn3D) { expect_hertz(3, 2, 0.02); }

// Nearly incompressible material has quadratic elements of itself, and gives them to the body that it touches.
TEST(QuadraticBodies, MayBeNearlyIncompressible) {
  for (const char* slave : {"slave = \"body\"\n", "slave = \"other\"\n"})
    expect_uniform_pressure(text_of({.dimension = 2,
                                     .upper = "[5, 3]",
                                     .lower = "[4, 4]",
                                     .material = "young = 1\npoisson = 0.4999\n",
                                     .more = slave}) +
                                "[solver]\ntolerance = 1e-10\n",
                            1e-9);
  Driver driver(scene_of(tables::block("steel", "[0, 0]", "[1, 1]", "[4, 4]", "young = 1000\npoisson = 0.3\n") +
                         tables::block("rubber", "[0.1, 1]", "[0.9, 1.6]", "[5, 4]", "young = 1\npoisson = 0.4999\n") +
                         tables::fix("steel", "bottom", "[0, 0]") + tables::fix("rubber", "top", "[0, -0.05]") +
                         pair("rubber", "bottom", "steel", "top")));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  expect_opposite(report.last().contact[0]);
  expect_balance(report.last(), 1e-8);
}

// A coarse slave whose faces the master covers in parts, some nodes next to nothing.
TEST(QuadraticBodies, TakeAFewCyclesWhereASlaveIsHardlyCovered) {
  Driver driver(scene_of(tables::block("rail", "[0, 0, 0]", "[4, 4, 1]", "[6, 6, 2]", material(1, 0.3, 2)) +
                         tables::block("slider", "[0.5, 0.4, 1]", "[1.5, 1.4, 1.6]", "[3, 3, 2]", material(2, 0.3, 2)) +
                         tables::fix("rail", "bottom", "[0, 0, 0]") + tables::fix("slider", "top", "[0, 0, -0.01]") +
                         pair("slider", "bottom", "rail", "top", "slave = \"other\"\n")));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged());
  EXPECT_LE(report.last().summary.iterations, 20);
  expect_opposite(report.last().contact[0]);
  expect_balance(report.last(), 1e-9);
}

}  // namespace
}  // namespace signorini::test
