#include <gmock/gmock.h>

#include <numbers>
#include <vector>

#include "tests/bodies/scenes.hpp"
#include "tests/bodies/sector.hpp"
#include "tests/support/folder.hpp"

// Round bodies pressed into each other, against closed forms.

namespace signorini::test {
namespace {

using std::numbers::pi;

double plane_modulus(double young, double poisson) { return young / (1 - poisson * poisson); }

/// Of an error that is to fall with the mesh size h, each half the one before: the mean order.
double order(const std::vector<double>& error) {
  return std::log2(error.front() / error.back()) / static_cast<double>(error.size() - 1);
}

struct Body {
  double radius = 1, young = 1, poisson = 0.3;
};

/// The lower half of a round body moved down onto the top of another one.
struct Round {
  Body upper, lower;
  double approach = 0.004;
  int refinements = 2;
  std::string more = "";
};

struct Found {
  double force, radius, pressure;
  int iterations;
};

Found found(const std::string& text) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  const ContactReport& contact = report.last().contact[0];
  expect_opposite(contact);
  return {length(contact.force), contact.radius, contact.max_pressure, report.last().summary.iterations};
}

// K. L. Johnson, Contact Mechanics, Cambridge 1985, ch. 4: force per length and half width of two cylinders.
std::string cylinders(const Round& scene) {
  const auto body = [](const char* name, const char* shape, double middle, const Body& of) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nshape = \"{}\"\ncenter = [0, {}]\nradius = {}\nsize = \"0.01 + 0.3 * sqrt(x^2 + "
        "y^2)\"\norder = 1\nyoung = {}\npoisson = {}\n",
        name, shape, middle, of.radius, of.young, of.poisson);
  };
  return body("upper", "half_disk", scene.upper.radius, scene.upper) +
         body("lower", "disk", -scene.lower.radius, scene.lower) +
         tables::fix("upper", "flat", fmt::format("[0, {}]", -scene.approach)) +
         fmt::format("[[fix]]\nbody = \"lower\"\nwhere = \"y < {}\"\nvalue = [0, 0]\n", -scene.lower.radius) +
         "[[obstacle]]\ntype = \"elastic\"\nbody = \"upper\"\non = \"curved\"\nother = \"lower\"\nother_where = \"y > "
         "-0.5\"\n" +
         scene.more + fmt::format("[refine]\nuniform = {}\n", scene.refinements);
}

void expect_hertz_in_plane(Round scene) {
  const double modulus = 1 / (1 / plane_modulus(scene.upper.young, scene.upper.poisson) +
                              1 / plane_modulus(scene.lower.young, scene.lower.poisson));
  const double curvature = 1 / scene.upper.radius + 1 / scene.lower.radius;
  std::vector<double> width_error, pressure_error;
  for (const int refinements : {1, 2, 3}) {
    scene.refinements = refinements;
    const Found f = found(cylinders(scene));
    const double width = std::sqrt(4 * f.force / (pi * modulus * curvature));
    width_error.push_back(std::abs(f.radius / width - 1));
    pressure_error.push_back(std::abs(f.pressure / (2 * f.force / (pi * width)) - 1));
    show("half width off by {:.2e}, pressure by {:.2e}, {} iterations\n", width_error.back(), pressure_error.back(),
         f.iterations);
    EXPECT_LE(f.iterations, 15);
  }
  EXPECT_LT(width_error.back(), 0.03);
  EXPECT_LT(pressure_error.back(), 0.03);
  EXPECT_GT(order(width_error), 0.5);
}

TEST(Cylinders, AsHertzSays) { expect_hertz_in_plane({}); }

TEST(Cylinders, OfDifferentRadiiAndMaterialsAsHertzSays) {
  expect_hertz_in_plane({.upper = {.radius = 1, .young = 1, .poisson = 0.2}, .lower = {.radius = 2, .young = 3}});
}

std::string spheres(const Round& scene) {
  const auto body = [](const char* name, const char* shape, double middle, const Body& of) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nshape = \"{}\"\ncenter = [0, 0, {}]\nradius = {}\nsize = \"0.05 + 0.4 * sqrt(x^2 + "
        "y^2 + z^2)\"\norder = 1\nyoung = {}\npoisson = {}\n",
        name, shape, middle, of.radius, of.young, of.poisson);
  };
  return body("upper", "half_ball", scene.upper.radius, scene.upper) +
         body("lower", "ball", -scene.lower.radius, scene.lower) +
         tables::fix("upper", "flat", fmt::format("[0, 0, {}]", -scene.approach)) +
         fmt::format("[[fix]]\nbody = \"lower\"\nwhere = \"z < {}\"\nvalue = [0, 0, 0]\n", -scene.lower.radius) +
         "[[obstacle]]\ntype = \"elastic\"\nbody = \"upper\"\non = \"curved\"\nother = \"lower\"\nother_where = \"z > "
         "-0.5\"\n" +
         scene.more + fmt::format("[refine]\nuniform = {}\n", scene.refinements);
}

void expect_hertz_in_space(Round scene) {
  const double modulus = 1 / (1 / plane_modulus(scene.upper.young, scene.upper.poisson) +
                              1 / plane_modulus(scene.lower.young, scene.lower.poisson));
  const double curvature = 1 / scene.upper.radius + 1 / scene.lower.radius;
  std::vector<double> radius_error, pressure_error;
  for (const int refinements : {1, 2}) {
    scene.refinements = refinements;
    const Found f = found(spheres(scene));
    const double radius = std::cbrt(3 * f.force / (4 * modulus * curvature));
    radius_error.push_back(std::abs(f.radius / radius - 1));
    pressure_error.push_back(std::abs(f.pressure / (3 * f.force / (2 * pi * radius * radius)) - 1));
    show("radius off by {:.2e}, pressure by {:.2e}, {} iterations\n", radius_error.back(), pressure_error.back(),
         f.iterations);
  }
  EXPECT_LT(radius_error.back(), 0.03);
  for (const double error : pressure_error) EXPECT_LT(error, 0.01);
}

TEST(Spheres, AsHertzSays) { expect_hertz_in_space({.approach = 0.02}); }

TEST(Spheres, OfDifferentRadiiAndMaterialsAsHertzSays) {
  expect_hertz_in_space(
      {.upper = {.radius = 1, .young = 3}, .lower = {.radius = 1.5, .young = 1, .poisson = 0.2}, .approach = 0.02});
}

// Normals of the slave or those of the master: a difference of higher order in the width of the contact, which the
// linearisation leaves out anyway.
TEST(Cylinders, HardlyDependOnThePairing) {
  const double normal = found(cylinders({.refinements = 3})).force;
  const double closest = found(cylinders({.refinements = 3, .more = "pairing = \"closest\"\n"})).force;
  show("force differs by {:.2e}\n", closest / normal - 1);
  EXPECT_NE(closest, normal);
  EXPECT_NEAR(closest, normal, 1e-4 * normal);
}

// Contact presses along the normals of a flat master, whatever is asked for of round ones.
TEST(Cylinders, PressAlongTheNormalsOfAFlatMaster) {
  for (const char* pairing : {"normal", "closest"}) {
    Driver driver(
        scene_of("[[body]]\nname = \"disk\"\nshape = \"half_disk\"\ncenter = [0, 1]\nradius = 1\nsize = 0.2\n" +
                 material(1) + tables::block("block", "[-1, -1]", "[1, 0]", "[8, 4]", material(2.5)) +
                 tables::fix("disk", "flat", "[0, -0.1]") + tables::fix("block", "bottom", "[0, 0]") +
                 pair("disk", "curved", "block", "top", fmt::format("slave = \"body\"\npairing = \"{}\"\n", pairing)) +
                 "[refine]\nuniform = 1\n"));
    ASSERT_TRUE(driver.solve().converged());
    const double sideways = driver.visit(0, [](const auto& run) {
      double most = 0;
      for (const auto& node : run.results().contact.nodes)
        if (node.contact) most = std::max(most, std::abs(node.direction[0]));
      return most;
    });
    EXPECT_EQ(sideways, 0);
  }
}

class BySymmetry : public Folder {};

// The right half of a round body on that of a block. The slave's node on the axis may slide along it only, and its face
// is inclined: what the master does not get is the fix's.
TEST_F(BySymmetry, HalvesAreInBalance) {
  for (const char* more : {"slave = \"body\"\n", "slave = \"other\"\n"})
    for (const double friction : {0.0, 0.3}) {
      SCOPED_TRACE(fmt::format("{} {}", more, friction));
      const std::string type = friction > 0 ? "elastic_coulomb" : "elastic";
      const std::string text =
          sector(folder_, "round",
                 {.inner = 0.4, .outer = 1, .from = -pi / 2, .to = 0, .along_radius = 4, .around = 12, .y = 1},
                 material(1)) +
          tables::block("block", "[0, -1]", "[1, 0]", "[8, 8]") + tables::fix("round", "first", "[0, \"free\"]") +
          tables::fix("round", "last", "[0, -0.08]") + tables::fix("block", "left", "[0, \"free\"]") +
          tables::fix("block", "bottom", "[\"free\", 0]") +
          pair("round", "outer", "block", "top", more + (friction > 0 ? fmt::format("friction = {}\n", friction) : ""),
               type);
      Driver driver(scene_of(text + "[refine]\nuniform = 1\n"));
      const Report& report = driver.solve();
      ASSERT_TRUE(report.converged()) << report.reason();
      EXPECT_GE(report.last().contact[0].nodes, 3);
      expect_opposite(report.last().contact[0]);
      expect_balance(report.last(), 1e-10);
    }
}

class InARing : public Folder {};

// A tube cut into sectors, pressed from outside, which nothing but contact between the cuts holds. These carry the hoop
// stress alone, of G. Lamé: p b^2 / (b^2 - a^2) (1 + a^2 / r^2).
TEST_F(InARing, BodiesAreInBalanceWithoutAnyFix) {
  constexpr int sectors = 5;
  constexpr double inner = 1, outer = 2, load = 0.01;
  std::vector<double> error;
  for (const int refinements : {0, 1, 2}) {
    std::string text;
    for (int k = 0; k < sectors; ++k)
      text += sector(folder_, fmt::format("s{}", k),
                     {inner, outer, 2 * pi * k / sectors, 2 * pi * (k + 1) / sectors, 4 + k, 6 + k}, material(1));
    for (int k = 0; k < sectors; ++k) {
      const std::string name = fmt::format("s{}", k), next = fmt::format("s{}", (k + 1) % sectors);
      text += fmt::format("[[load]]\nbody = \"{}\"\non = \"outer\"\nvalue = [\"-{} * nx\", \"-{} * ny\"]\n", name, load,
                          load);
      text += pair(name, "last", next, "first");
    }
    Driver driver(scene_of(text + fmt::format("[refine]\nuniform = {}\n", refinements)));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    expect_balance(report.last(), 1e-10);
    double worst = 0;
    for (const ContactReport& contact : report.last().contact) {
      expect_opposite(contact);
      worst = std::max(worst, std::abs(length(contact.force) / (load * outer) - 1));  // of the resultant
    }
    error.push_back(driver.visit(0, [&](const auto& run) {
      double most = 0;
      for (const auto& node : run.results().contact.nodes) {
        const auto& x = run.nodes().at(node.vertex);
        const double r2 = x[0] * x[0] + x[1] * x[1];
        const double exact = load * outer * outer / (outer * outer - inner * inner) * (1 + inner * inner / r2);
        most = std::max(most, std::abs(node.pressure / exact - 1));
      }
      return most;
    }));
    show("{} iterations, force off by {:.2e}, pressure by {:.2e}, undetermined: {}\n", report.last().summary.iterations,
         worst, error.back(), report.last().undetermined.size());
    EXPECT_LT(worst, 1e-2);
    // All together, and along the cuts: of five times three motions five contacts decide two each, but the last one's
    // rotation is that of the others.
    EXPECT_EQ(report.last().undetermined.size(), 6u);
  }
  EXPECT_LT(error.back(), 0.04);
  EXPECT_GT(order(error), 0.9);
}

class InAHole : public Folder {};

/// Half the angle up to which a pin touches the hole of a large plate of the same material: of E' play / force, where
/// E' = E / (1 - nu^2). A. Persson, On the stress distribution of cylindrical elastic bodies in contact, Gothenburg
/// 1964; M. Ciavarella, P. Decuzzi, Int. J. Solids Struct. 38 (2001) 4507: with b = tan(angle / 2) it is
/// (2 - ln(b^2 + 1) - 2 b^4) / (pi b^2 (b^2 + 1)).
double persson_angle(double ratio) {
  double low = 0, high = 1;
  for (int step = 0; step < 60; ++step) {
    const double b = 0.5 * (low + high), square = b * b;
    const double found = (2 - std::log(square + 1) - 2 * square * square) / (pi * square * (square + 1));
    (found > ratio ? low : high) = b;
  }
  return 2 * std::atan(low);
}

// A pin in a hole with a play of 0.1 %, which closes over a third of its circumference.
TEST_F(InAHole, APinTouchesAsPerssonSays) {
  constexpr double play = 1e-3;
  const std::string text =
      sector(folder_, "plate", {.inner = 1 + play, .outer = 12, .along_radius = 20, .around = 160}, material(1)) +
      sector(folder_, "pin", {.inner = 0.1, .outer = 1, .along_radius = 16, .around = 144}, material(1)) +
      tables::fix("plate", "outer", "[0, 0]") + tables::fix("pin", "inner", "[0, -0.004]") +
      pair("pin", "outer", "plate", "inner");
  for (const int refinements : {1, 2}) {
    Driver driver(scene_of(text + fmt::format("[refine]\nuniform = {}\n", refinements)));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    const ContactReport& contact = report.last().contact[0];
    expect_opposite(contact);
    const double angle = contact.area / 2;
    const double expected = persson_angle(plane_modulus(1, 0.3) * play / contact.force[1]);
    show("angle {:.4g} degrees, exactly {:.4g}; {} iterations\n", angle * 180 / pi, expected * 180 / pi,
         report.last().summary.iterations);
    EXPECT_NEAR(angle, expected, 0.03 * expected);
    EXPECT_LE(report.last().summary.iterations, 30);
  }
}

class RoundBodies : public Folder {};

// A disk may turn in a ring, or both together: chords and arcs of the surfaces hinder that by next to nothing, and what
// presses keeps its contact where the solution is moved along such motions.
TEST_F(RoundBodies, KeepTheirContactWhereTheyMayTurn) {
  const std::string ring =
      sector(folder_, "ring", {.inner = 1, .outer = 2, .along_radius = 4, .around = 24}, material(3, 0.25, 2));
  const auto disk = [](double radius) {
    return fmt::format("[[body]]\nname = \"disk\"\nshape = \"disk\"\ncenter = [0, 0]\nradius = {}\nsize = 0.2\n",
                       radius) +
           material(1, 0.3, 2);
  };
  const auto report = [](const std::string& text) {
    Driver driver(scene_of(text + "[refine]\nuniform = 2\n"));
    driver.solve();
    return driver.report();
  };
  const Report loaded =
      report(ring + disk(0.99) + "[[fix]]\nbody = \"ring\"\non = \"outer\"\nvalue = [0, 0]\n" +
             "[[load]]\nbody = \"disk\"\nvalue = [0, -0.001]\n" + pair("disk", "boundary", "ring", "inner"));
  EXPECT_FALSE(loaded.last().undetermined.empty());
  expect_balance(loaded.last(), 1e-9);
  const Report pressed =
      report(ring + disk(1) + pair("disk", "boundary", "ring", "inner", "gap = -0.002\nslave = \"body\""));
  EXPECT_EQ(pressed.last().contact[0].open_nodes, 0);
  expect_balance(pressed.last(), 1e-9);
}

// What friction alone keeps from turning. A start from a coarser mesh may lead nowhere; others follow.
TEST_F(RoundBodies, AreHeldByFrictionAlone) {
  const std::string bodies =
      sector(folder_, "ring", {.inner = 1, .outer = 3, .along_radius = 3, .around = 32}, material(1)) +
      "[[body]]\nname = \"disk\"\nshape = \"disk\"\ncenter = [0, -0.01]\nradius = 0.99\nsize = 0.2\n" + material(1) +
      "[[fix]]\nbody = \"ring\"\non = \"outer\"\nvalue = [0, 0]\n[refine]\nuniform = 1\n";
  const auto report = [&](const std::string& load, const std::string& keys) {
    Driver driver(scene_of(bodies + "[[load]]\nbody = \"disk\"\nvalue = " + load + "\n" +
                           pair("disk", "boundary", "ring", "inner", keys, "elastic_coulomb")));
    driver.solve();
    return driver.report();
  };
  for (const char* slave : {"body", "other"})
    for (const char* pairing : {"normal", "closest"})
      for (const double friction : {0.1, 0.6}) {
        const std::string keys =
            fmt::format("slave = \"{}\"\npairing = \"{}\"\nfriction = {}\n", slave, pairing, friction);
        const Report held = report("[0.0003, -0.001]", keys);
        EXPECT_TRUE(held.converged()) << keys << held.reason();
        expect_balance(held.last(), 1e-6);
        show("{} cycles, {} stages\n", held.last().summary.iterations, held.last().summary.stages.size());
      }
  // A twentieth of what it would take; far away linearised contact is wedged, which is no solution.
  const Report slides = report("['0.001 * (y - x)', -0.001]", "friction = 0.03\npairing = \"closest\"\n");
  EXPECT_FALSE(slides.converged());
  EXPECT_THAT(slides.reason(), testing::HasSubstr("friction"));
}

}  // namespace
}  // namespace signorini::test
