#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "apps/scenes/tables.hpp"
#include "driver/driver.hpp"
#include "tests/verification/run.hpp"

// Elastic bodies in contact with each other, against closed forms, one-body contact and each other.

namespace signorini::test {
namespace {

/// The slave is the one named first.
std::string pair(const std::string& slave, const std::string& on, const std::string& master,
                 const std::string& other_on, const std::string& more = "") {
  return fmt::format(
      "[[obstacle]]\ntype = \"elastic\"\nbody = \"{}\"\non = \"{}\"\nother = \"{}\"\nother_on = \"{}\"\nslave = "
      "\"body\"\n{}",
      slave, on, master, other_on, more);
}

/// A press of two blocks between a support and a pressure of 0.1: each may slide along x (and y) but for its left
/// (front) face, so that the stress is uniaxial everywhere.
struct Press {
  std::string upper = "[5, 3]", lower = "[4, 4]";  // cells
  bool upper_is_slave = true;
  std::string more = "";
};

std::string press_2d(const Press& press) {
  using tables::fix, tables::load;
  return tables::block("lower", "[0, 0]", "[1, 1]", press.lower) +
         tables::block("upper", "[0, 1]", "[1, 1.75]", press.upper) + fix("lower", "bottom", "[\"free\", 0]") +
         fix("lower", "left", "[0, \"free\"]") + fix("upper", "left", "[0, \"free\"]") +
         load("upper", "[0, -0.1]", "top") +
         (press.upper_is_slave ? pair("upper", "bottom", "lower", "top") : pair("lower", "top", "upper", "bottom")) +
         press.more;
}

std::string press_3d(const Press& press) {
  using tables::fix, tables::load;
  return tables::block("lower", "[0, 0, 0]", "[1, 1, 1]", press.lower) +
         tables::block("upper", "[0, 0, 1]", "[1, 1, 1.5]", press.upper) +
         fix("lower", "bottom", "[\"free\", \"free\", 0]") + fix("lower", "left", "[0, \"free\", \"free\"]") +
         fix("upper", "left", "[0, \"free\", \"free\"]") + fix("lower", "front", "[\"free\", 0, \"free\"]") +
         fix("upper", "front", "[\"free\", 0, \"free\"]") + load("upper", "[0, 0, -0.1]", "top") +
         (press.upper_is_slave ? pair("upper", "bottom", "lower", "top") : pair("lower", "top", "upper", "bottom")) +
         press.more;
}

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml", "."); }

/// The largest deviation of the nodal pressures from `expected`, relative to it.
double deviation(const Driver& driver, double expected) {
  return driver.visit(0, [&](const auto& run) {
    double worst = 0;
    for (const auto& node : run.results().contact.nodes)
      worst = std::max(worst, std::abs(node.pressure - expected) / expected);
    return worst;
  });
}

void expect_uniform_pressure(const std::string& text) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  EXPECT_LT(deviation(driver, 0.1), 1e-9);
  const StepReport& step = report.last();
  const int up = report.dimension - 1;
  EXPECT_NEAR(std::abs(step.contact[0].force[up]), 0.1, 1e-11);
  for (const BalanceReport& balance : step.balance)
    for (const double left : balance.sum()) EXPECT_NEAR(left, 0, 1e-11) << balance.body;
  show("{} iterations, deviation {:.2e}\n", step.summary.iterations, deviation(driver, 0.1));
}

TEST(TwoBodies, PassThePatchTestIn2D) {
  for (const bool upper_is_slave : {true, false})
    for (const char* cells : {"[4, 3]", "[8, 3]", "[5, 3]", "[29, 3]", "[1, 1]"})
      for (const char* refined : {"", "[refine]\nuniform = 2\n"}) {
        SCOPED_TRACE(fmt::format("{} {} {}", upper_is_slave, cells, refined));
        expect_uniform_pressure(press_2d({cells, "[4, 4]", upper_is_slave, refined}));
      }
}

TEST(TwoBodies, PassThePatchTestIn3D) {
  for (const bool upper_is_slave : {true, false})
    for (const char* cells : {"[2, 2, 1]", "[3, 5, 1]", "[7, 7, 2]"})
      for (const char* refined : {"", "[refine]\nuniform = 1\n"}) {
        SCOPED_TRACE(fmt::format("{} {} {}", upper_is_slave, cells, refined));
        expect_uniform_pressure(press_3d({cells, "[2, 2, 2]", upper_is_slave, refined}));
      }
}

// Faces count as far as the other body is in front of them, whichever is the slave.
TEST(TwoBodies, AreaIsWhatIsInFrontOfTheOtherBody) {
  for (const int cells : {5, 7, 11, 28})
    for (const char* slave : {"body", "other"}) {
      Driver driver(scene_of(
          tables::block("wide", "[-1, 0]", "[1, 1]", fmt::format("[{}, 4]", cells)) +
          tables::block("narrow", "[-0.5, -1]", "[0.5, 0]", "[9, 4]") + tables::fix("narrow", "bottom", "[0, 0]") +
          tables::fix("wide", "top", "[0, -0.02]") +
          fmt::format("[[obstacle]]\ntype = \"elastic\"\nbody = \"wide\"\non = \"bottom\"\nother = \"narrow\"\n"
                      "other_on = \"top\"\nslave = \"{}\"\n",
                      slave)));
      const ContactReport& contact = driver.solve().last().contact[0];
      EXPECT_NEAR(contact.area, 1, 1e-9) << cells << slave;
      EXPECT_LT(contact.max_pressure, 4 * std::abs(contact.force[1])) << cells << slave;
    }
}

/// What is recovered is the same pressure on both sides.
void expect_recovered(const std::string& text, double area, double pressure) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  EXPECT_TRUE(report.warnings.empty());
  const ContactReport& contact = report.last().contact[0];
  EXPECT_NEAR(contact.area, area, 1e-8 * area);
  EXPECT_NEAR(contact.max_pressure, pressure, 1e-8 * pressure);
  driver.visit(0, [&](const auto& run) {
    for (const auto& node : run.results().contact.nodes) EXPECT_NEAR(node.recovered, pressure, 1e-8 * pressure);
    for (const auto& node : run.results().masters)
      if (node.contact) {
        EXPECT_NEAR(node.recovered, pressure, 1e-8 * pressure);
      }
  });
}

// A block hangs over another one, and is pressed on there as from below: the same stress everywhere. The load has the
// moments of one of 0.01 for x > 1 within the last face of the block.
TEST(TwoBodies, PressuresAreKnownUpToTheEndOfTheOtherBody) {
  const char* strained = "[\"0.0039 * x\", \"-0.0091 * y\"]";
  for (const std::string& contact : {pair("upper", "bottom", "lower", "top"), pair("lower", "top", "upper", "bottom")})
    expect_recovered(tables::block("lower", "[0, 0]", "[1, 1]", "[3, 3]") +
                         tables::block("upper", "[0, 1]", "[1.3, 2]", "[4, 3]") +
                         tables::fix("lower", "bottom", strained) + tables::fix("upper", "top", strained) +
                         "[[load]]\nbody = \"upper\"\non = \"bottom\"\nvalue = [0, \"0.01 * (x > 0.975 ? "
                         "0.92307692307692335 + 1.3108784706417589 * (x - 1.1375) : 0)\"]\n" +
                         contact,
                     1, 0.01);
}

// Faces around an edge are picked, and are in front of nothing.
TEST(TwoBodies, FacesAroundAnEdgeAreNoPartOfTheContact) {
  for (const std::string& contact :
       {pair("upper", "boundary", "lower", "boundary"), pair("lower", "boundary", "upper", "boundary")})
    expect_recovered(tables::block("lower", "[0, 0]", "[1, 1]", "[3, 3]", "order = 1\nyoung = 1\npoisson = 0\n") +
                         tables::block("upper", "[0, 1]", "[1, 2]", "[4, 3]", "order = 1\nyoung = 1\npoisson = 0\n") +
                         tables::fix("lower", "bottom", "[0, 0]") + tables::fix("upper", "top", "[0, -0.02]") + contact,
                     1, 0.01);
}

/// Lower half of a disk of radius 1, moved down onto a block.
std::string disk_on_block(int refinements, const std::string& obstacle, double block_stiffness = 1) {
  return fmt::format(
             "[[body]]\nname = \"disk\"\nshape = \"half_disk\"\ncenter = [0, 1]\nradius = 1\n"
             "size = \"0.03 + 0.3 * sqrt(x^2 + y^2)\"\norder = 1\nyoung = 1\npoisson = 0.3\n[refine]\nuniform = {}\n",
             refinements) +
         tables::block("block", "[-2, -2]", "[2, 0]", "[32, 16]",
                       fmt::format("order = 1\nyoung = {}\npoisson = 0.3\n", block_stiffness)) +
         tables::fix("disk", "flat", "[0, -0.02]") + tables::fix("block", "bottom", "[0, 0]") + obstacle;
}

struct Pressed {
  double force, half_width, pressure;
  int iterations;
};

Pressed pressed(const std::string& text) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  const ContactReport& contact = report.last().contact[0];
  return {std::abs(contact.force[1]), contact.radius, contact.max_pressure, report.last().summary.iterations};
}

// K. L. Johnson, Contact Mechanics, Cambridge 1985, ch. 4: with 1/E* = 2 (1 - nu^2) / E
TEST(TwoBodies, PressEachOtherAsHertzSays) {
  const double stiffness = 1 / (2 * (1 - 0.3 * 0.3));
  const Pressed found = pressed(disk_on_block(4, pair("disk", "curved", "block", "top")));
  const double half_width = std::sqrt(4 * found.force / (pi * stiffness));
  show("half width {:.4g}, pressure {:.4g} of theirs, {} iterations\n", found.half_width / half_width,
       found.pressure / (2 * found.force / (pi * half_width)), found.iterations);
  EXPECT_NEAR(found.half_width, half_width, 0.03 * half_width);
  EXPECT_NEAR(found.pressure, 2 * found.force / (pi * half_width), 0.03 * found.pressure);
  EXPECT_LE(found.iterations, 13);
}

TEST(TwoBodies, PressAlikeWhicheverIsTheSlave) {
  std::vector<double> difference;
  for (const int refinements : {1, 2, 3, 4}) {
    const Pressed disk = pressed(disk_on_block(refinements, pair("disk", "curved", "block", "top")));
    const Pressed block = pressed(disk_on_block(refinements, pair("block", "top", "disk", "curved")));
    difference.push_back(std::abs(disk.force - block.force) / disk.force);
    show("{}: force differs by {:.2e}, {} and {} iterations\n", refinements, difference.back(), disk.iterations,
         block.iterations);
    EXPECT_LE(std::max(disk.iterations, block.iterations), 15);
  }
  EXPECT_LT(difference.back(), 1e-3);
  EXPECT_LT(difference[3], 0.5 * difference[1]);
}

TEST(TwoBodies, AStiffOneIsARigidObstacle) {
  const Pressed rigid = pressed(disk_on_block(  // the normal is that of the plane in both cases
      3,
      "[[obstacle]]\ntype = \"contact\"\nbody = \"disk\"\non = \"curved\"\nshape = \"expression\"\n"
      "distance = \"y\"\n"));
  constexpr double of_means = 5e-4;  // the mortar's mean distances are not the distances of nodes
  double last = infinity;
  for (const double ratio : {1e2, 1e4, 1e6, 1e8}) {
    const Pressed found = pressed(disk_on_block(3, pair("disk", "curved", "block", "top"), ratio));
    const double off = std::abs(found.force - rigid.force) / rigid.force;
    show("{:g}: force off by {:.2e}, {} iterations\n", ratio, off, found.iterations);
    EXPECT_LT(off, std::max(last, of_means));
    EXPECT_LE(found.iterations, 2 * rigid.iterations);
    last = off;
  }
  EXPECT_LT(last, of_means);
}

/// Three blocks, the middle one held by contact along y alone.
std::string row(const std::string& type, const std::string& more) {
  const auto between = [&](const char* slave, const char* master) {
    return fmt::format(
        "[[obstacle]]\ntype = \"{}\"\nbody = \"{}\"\non = \"bottom\"\nother = \"{}\"\nother_on = \"top\"\nslave = "
        "\"body\"\n",
        type, slave, master);
  };
  return tables::block("a", "[0, 0]", "[2, 1]", "[8, 4]") +
         tables::block("b", "[0.3, 1]", "[1.7, 1.5]", "[9, 3]", "order = 1\nyoung = 10\npoisson = 0.2\n") +
         tables::block("c", "[0.5, 1.5]", "[1.2, 2]", "[5, 4]", "order = 1\nyoung = 0.5\npoisson = 0.3\n") +
         tables::fix("a", "bottom", "[0, 0]") + tables::fix("b", "left", "[0, \"free\"]") +
         tables::fix("c", "top", "[\"0.01 * t\", \"-0.02 * t\"]") + between("b", "a") + more + between("c", "b") +
         more + "[refine]\nuniform = 2\n[steps]\ncount = 3\n";
}

void expect_as_newton(const std::string& text) {
  Driver cycles(scene_of(text)),
      newton(parse_scene(text, "test.toml", ".", std::vector<std::string>{"solver.method=\"newton\""}));
  ASSERT_TRUE(cycles.solve().converged());
  ASSERT_TRUE(newton.solve().converged());
  const std::vector<double> u = cycles.solution(), expected = newton.solution();
  double size = 0, apart = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    size = std::max(size, std::abs(expected[k]));
    apart = std::max(apart, std::abs(u[k] - expected[k]));
  }
  EXPECT_LT(apart, 1e-7 * size);
  for (std::size_t k = 0; k < 2; ++k) {
    const ContactReport &a = cycles.report().last().contact[k], &b = newton.report().last().contact[k];
    EXPECT_EQ(a.nodes, b.nodes);
    EXPECT_EQ(a.slip_nodes, b.slip_nodes);
    EXPECT_GT(a.nodes, 0);
  }
}

TEST(TwoBodies, InARowAgreeWithNewton) { expect_as_newton(row("elastic", "")); }

TEST(TwoBodies, InARowWithFrictionAgreeWithNewton) { expect_as_newton(row("elastic_coulomb", "friction = 0.3\n")); }

TEST(TwoBodies, InARowBalance) {
  Driver driver(scene_of(row("elastic_coulomb", "friction = 0.3\n")));
  const StepReport& step = driver.solve().last();
  ASSERT_EQ(step.balance.size(), 3u);
  for (const BalanceReport& balance : step.balance)
    for (const double left : balance.sum()) EXPECT_NEAR(left, 0, 1e-9) << balance.body;
  EXPECT_GT(step.contact[1].slip_nodes, 0);
  EXPECT_GT(step.contact[0].stick_nodes, 0);
}

/// A block that lies on another one, 0.01 above it at the start.
std::string lying(const std::string& load) {
  return tables::block("below", "[0, 0]", "[2, 1]", "[8, 4]") +
         tables::block("above", "[0.5, 1.01]", "[1.5, 1.5]", "[9, 5]") + tables::fix("below", "bottom", "[0, 0]") +
         tables::load("above", load) + pair("above", "bottom", "below", "top") + "[refine]\nuniform = 2\n";
}

TEST(TwoBodies, OneMayBeHeldByContactAlone) {
  Driver driver(scene_of(lying("[0, -0.01]")));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged());
  EXPECT_NEAR(report.last().contact[0].force[1], 0.01 * 0.49, 1e-10);
  EXPECT_NEAR(report.last().contact[0].force[0], 0, 1e-10);
  ASSERT_EQ(report.last().undetermined.size(), 1u);
  EXPECT_NE(report.last().undetermined[0].find("translation along (1, 0) of the body 'above' around (1, 1.255)"),
            std::string::npos)
      << report.last().undetermined[0];
}

void expect_error(const std::string& text, Exit status, const std::string& part) {
  try {
    Driver(scene_of(text)).solve();
    ADD_FAILURE() << "no error: " << part;
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(TwoBodies, SlideAwayWhereNothingHoldsThem) {
  expect_error(lying("[0.001, -0.01]"), Exit::no_solution,
               "translation along (1, 0) of the body 'above' around (1, 1.255)");
}

TEST(TwoBodies, AreRefusedWhereTheyCannotTouch) {
  const std::string start = lying("[0, -0.01]");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = start;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  expect_error(with("[0.5, 1.01]", "[0.5, 0.6]"), Exit::input, "the bodies overlap at the start, by 0.4");
  expect_error(with("other = \"below\"", "other = \"bellow\""), Exit::input, "did you mean 'below'?");
  expect_error(with("other_on = \"top\"", "other_on = \"topp\""), Exit::input, "did you mean 'below/top'?");
  expect_error(with("type = \"elastic\"", "type = \"contact\""), Exit::input, "acts on one body");
  expect_error(with("other = \"below\"\nother_on = \"top\"\nslave = \"body\"", ""), Exit::input, "missing key 'other'");
  expect_error(with("order = 1", "order = 2"), Exit::input, "elements of order");
  expect_error(start + tables::plane("above", "bottom", "[0, 1]", "[0, 1]"), Exit::input,
               "expected faces apart from those");
}

}  // namespace
}  // namespace signorini::test
