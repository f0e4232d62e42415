#include <gmock/gmock.h>

#include "tests/bodies/scenes.hpp"
#include "tests/bodies/sector.hpp"
#include "tests/support/folder.hpp"

// Bodies that are glued together, on meshes that do not match: against closed forms, and against one body.

namespace signorini::test {
namespace {

using tables::block, tables::fix, tables::load, tables::probe;

std::string glue(const std::string& body, const std::string& on, const std::string& other, const std::string& other_on,
                 const std::string& more = "") {
  return pair(body, on, other, other_on, more, "tied");
}

std::string refined(int uniform) { return fmt::format("[refine]\nuniform = {}\n", uniform); }

std::string fix_where(const std::string& body, const std::string& where, const std::string& value) {
  return fmt::format("[[fix]]\nbody = \"{}\"\nwhere = \"{}\"\nvalue = {}\n", body, where, value);
}

const std::vector<double>& probed(const Report& report, const std::string& name) {
  return std::ranges::find(report.last().probes, name, &ProbeReport::name)->value;
}

struct Case {
  int dimension, order;
  const char* slave;
};

class Tie : public testing::TestWithParam<Case> {
 protected:
  int D() const { return GetParam().dimension; }
  int order() const { return GetParam().order; }
  std::string slave() const { return fmt::format("slave = \"{}\"\n", GetParam().slave); }
  std::string in(const char* plane, const char* space) const { return D() == 2 ? plane : space; }

  /// Two blocks on each other, of which the upper one is narrower where `overhang` is.
  std::string blocks(const std::string& lower, const std::string& upper, double overhang = 0) const {
    const double a = overhang, b = 1 - overhang;
    if (D() == 2)
      return block("lower", "[0, 0]", "[1, 0.5]", "[3, 2]", lower) +
             block("upper", fmt::format("[{}, 0.5]", a), fmt::format("[{}, 1]", b), "[4, 3]", upper);
    return block("lower", "[0, 0, 0]", "[1, 1, 0.5]", "[3, 2, 2]", lower) +
           block("upper", fmt::format("[{}, {}, 0.5]", a, a), fmt::format("[{}, {}, 1]", b, b), "[2, 3, 2]", upper);
  }
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return fmt::format("In{}DOrder{}{}", info.param.dimension, info.param.order, info.param.slave);
}

// The ends move by a linear displacement, and the sides are loaded by its stress: it is the solution.
TEST_P(Tie, PassesThePatchTest) {
  const std::string u = in(R"(["0.01 * x + 0.02 * y", "-0.015 * x + 0.03 * y"])",
                           R"(["0.01 * x + 0.02 * y - 0.01 * z", "-0.015 * x + 0.03 * y", "0.01 * y - 0.02 * z"])");
  const std::string at = in("[0.37, 0.5]", "[0.37, 0.61, 0.5]");
  const double mu = 2.0 / 2.6, lambda = 2 * 0.3 / (1.3 * 0.4), trace = D() == 2 ? 0.04 : 0.02;
  const double xx = lambda * trace + 2 * mu * 0.01, yy = lambda * trace + 2 * mu * 0.03, xy = mu * 0.005,
               xz = -mu * 0.01, yz = mu * 0.01;
  const auto traction = [&](const char* body, const char* on, double sign, double x, double y, double z) {
    return load(body,
                D() == 2 ? fmt::format("[{:.17g}, {:.17g}]", sign * x, sign * y)
                         : fmt::format("[{:.17g}, {:.17g}, {:.17g}]", sign * x, sign * y, sign * z),
                on);
  };
  std::string text = blocks(material(2, 0.3, order()), material(2, 0.3, order())) + fix("lower", "bottom", u) +
                     fix("upper", "top", u) + glue("upper", "bottom", "lower", "top", slave());
  for (const char* body : {"lower", "upper"}) {
    text += traction(body, "left", -1, xx, xy, xz) + traction(body, "right", 1, xx, xy, xz);
    if (D() == 3) text += traction(body, "front", -1, xy, yy, yz) + traction(body, "back", 1, xy, yy, yz);
  }
  Driver driver(scene_of(text + probe("above", "upper", at) + probe("below", "lower", at) +
                         "[solver]\ntolerance = 1e-12\n" + refined(1)));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  const double x = 0.37, y = D() == 2 ? 0.5 : 0.61, z = 0.5;
  const std::vector<double> expected =
      D() == 2 ? std::vector{0.01 * x + 0.02 * y, -0.015 * x + 0.03 * y}
               : std::vector{0.01 * x + 0.02 * y - 0.01 * z, -0.015 * x + 0.03 * y, 0.01 * y - 0.02 * z};
  for (const char* name : {"above", "below"})
    for (int i = 0; i < D(); ++i) EXPECT_NEAR(probed(report, name)[i], expected[i], 1e-11);
  expect_opposite(report.last().contact[0]);
  expect_balance(report.last(), 1e-10);
}

// The same where fixes prescribe the ends of the interface.
TEST_P(Tie, PassesThePatchTestBetweenFixes) {
  if (D() == 3) GTEST_SKIP() << "faces in corners, all of whose nodes are prescribed, are left to the fixes";
  const char* u = R"(["0.01 * x + 0.02 * y", "-0.015 * x + 0.03 * y"])";
  Driver driver(scene_of(blocks(material(2, 0.3, order()), material(2, 0.3, order())) +
                         fix_where("lower", "y < 0.5 || x == 0 || x == 1", u) +
                         fix_where("upper", "y > 0.5 || x == 0 || x == 1", u) +
                         glue("upper", "bottom", "lower", "top", slave()) + probe("above", "upper", "[0.37, 0.5]") +
                         probe("below", "lower", "[0.37, 0.5]") + "[solver]\ntolerance = 1e-12\n" + refined(1)));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  for (const char* name : {"above", "below"}) {
    EXPECT_NEAR(probed(report, name)[0], 0.0137, 1e-11);
    EXPECT_NEAR(probed(report, name)[1], 0.00945, 1e-11);
  }
  expect_balance(report.last(), 1e-10);
}

// One stress in both, whichever side has the unknowns: the tie carries all of the load, up to its ends.
TEST_P(Tie, CarriesAUniformStress) {
  const auto roller = [&](const char* body) {
    return fix(body, "left", in("[0, \"free\"]", "[0, \"free\", \"free\"]")) +
           (D() == 3 ? fix(body, "front", "[\"free\", 0, \"free\"]") : "");
  };
  Driver driver(scene_of(
      blocks(material(2, 0.3, order()), material(2, 0.3, order())) + roller("lower") + roller("upper") +
      fix("lower", "bottom", in("[\"free\", 0]", "[\"free\", \"free\", 0]")) +
      load("upper", in("[0, -0.01]", "[0, 0, -0.01]"), "top") + glue("upper", "bottom", "lower", "top", slave()) +
      probe("corner", "upper", in("[1, 1]", "[1, 1, 1]")) + "[solver]\ntolerance = 1e-12\n" + refined(1)));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  const ContactReport& contact = report.last().contact[0];
  EXPECT_TRUE(contact.tied);
  EXPECT_NEAR(contact.force.back(), 0.01, 1e-11);
  EXPECT_NEAR(contact.force.front(), 0, 1e-11);
  // Plane strain; in space the stress is along z alone.
  const double axial = D() == 2 ? -0.01 / 2 * (1 - 0.09) : -0.01 / 2,
               side = D() == 2 ? 0.01 / 2 * 0.3 * 1.3 : 0.3 * 0.01 / 2;
  EXPECT_NEAR(probed(report, "corner").back(), axial, 1e-11);
  EXPECT_NEAR(probed(report, "corner").front(), side, 1e-11);
  expect_opposite(contact);
  expect_balance(report.last(), 1e-11);
}

// Two materials in a row, without contraction: F (L1 / E1 + L2 / E2).
TEST_P(Tie, OfABarOfTwoMaterialsAddsUpTheirStrains) {
  Driver driver(scene_of(
      blocks(material(1, 0, order()), material(10, 0, order())) + fix("lower", "bottom", in("[0, 0]", "[0, 0, 0]")) +
      load("upper", in("[0, 0.01]", "[0, 0, 0.01]"), "top") + glue("upper", "bottom", "lower", "top", slave()) +
      fix("lower", "left", in("[0, \"free\"]", "[0, \"free\", \"free\"]")) +
      fix("lower", "right", in("[0, \"free\"]", "[0, \"free\", \"free\"]")) +
      fix("upper", "left", in("[0, \"free\"]", "[0, \"free\", \"free\"]")) +
      fix("upper", "right", in("[0, \"free\"]", "[0, \"free\", \"free\"]")) +
      probe("top", "upper", in("[0.5, 1]", "[0.5, 0.5, 1]")) + "[solver]\ntolerance = 1e-12\n"));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  EXPECT_NEAR(report.last().contact[0].force.back(), -0.01, 1e-11);
  EXPECT_NEAR(probed(report, "top").back(), 0.01 * (0.5 / 1 + 0.5 / 10), 1e-10);
}

// The same mesh cut in two is the same problem.
TEST_P(Tie, OfMatchingMeshesIsOneBody) {
  const std::string m = material(1, 0.3, order());
  const std::string ends = fix("left", "left", in("[0, 0]", "[0, 0, 0]"));
  const std::string at = in("[3, 0.5]", "[3, 0.5, 0.5]");
  const auto solve = [&](const std::string& text) {
    Driver driver(scene_of(text + "[solver]\ntolerance = 1e-12\n" + refined(1)));
    driver.solve();
    return driver.report();
  };
  const std::string shear = in("[0, -0.001]", "[0, 0.0005, -0.001]");
  const Report one = solve((D() == 2 ? block("left", "[0, 0]", "[3, 1]", "[6, 2]", m)
                                     : block("left", "[0, 0, 0]", "[3, 1, 1]", "[6, 2, 2]", m)) +
                           ends + load("left", shear, "right") + probe("end", "left", at));
  const Report two = solve(
      (D() == 2 ? block("left", "[0, 0]", "[1.5, 1]", "[3, 2]", m) + block("right", "[1.5, 0]", "[3, 1]", "[3, 2]", m)
                : block("left", "[0, 0, 0]", "[1.5, 1, 1]", "[3, 2, 2]", m) +
                      block("right", "[1.5, 0, 0]", "[3, 1, 1]", "[3, 2, 2]", m)) +
      ends + load("right", shear, "right") + glue("right", "left", "left", "right", slave()) +
      probe("end", "right", at));
  ASSERT_TRUE(one.converged()) << one.reason();
  ASSERT_TRUE(two.converged()) << two.reason();
  for (int i = 0; i < D(); ++i) EXPECT_NEAR(probed(two, "end")[i], probed(one, "end")[i], 1e-9 * 0.1);
  // The moment about the interface is the load at its lever, about the origin that of the load.
  EXPECT_NEAR(two.last().contact[0].force.back(), 0.001, 1e-10);
  EXPECT_NEAR(std::abs(two.last().contact[0].moment[D() == 2 ? 0 : 1]), 0.003, 1e-9);
  show("{}D order {}: {} cycles, one body {}\n", D(), order(), two.last().summary.iterations,
       one.last().summary.iterations);
  EXPECT_LE(two.last().summary.iterations, one.last().summary.iterations + 3);
}

INSTANTIATE_TEST_SUITE_P(Everywhere, Tie,
                         testing::Values(Case{2, 1, "body"}, Case{2, 1, "other"}, Case{2, 2, "body"},
                                         Case{2, 2, "other"}, Case{3, 1, "body"}, Case{3, 1, "other"},
                                         Case{3, 2, "body"}, Case{3, 2, "other"}),
                         name_of);

double bending_of_cut_cantilever(const char* slave, int uniform) {
  const std::string m = material(1, 0.3, 2);
  Driver driver(scene_of(block("left", "[0, 0]", "[1.4, 1]", "[4, 3]", m) +
                         block("right", "[1.4, 0]", "[3, 1]", "[5, 4]", m) + fix("left", "left", "[0, 0]") +
                         load("right", "[0, -0.001]", "right") +
                         glue("right", "left", "left", "right", fmt::format("slave = \"{}\"\n", slave)) +
                         probe("end", "right", "[3, 0.5]") + refined(uniform)));
  EXPECT_TRUE(driver.solve().converged());
  return probed(driver.report(), "end")[1];
}

// Either choice of the slave tends to the deflection of one body.
TEST(TiedBodies, AgreeWithOneBodyWhicheverIsTheSlave) {
  Driver one(scene_of(block("left", "[0, 0]", "[3, 1]", "[24, 8]", material(1, 0.3, 2)) +
                      fix("left", "left", "[0, 0]") + load("left", "[0, -0.001]", "right") +
                      probe("end", "left", "[3, 0.5]") + refined(2)));
  ASSERT_TRUE(one.solve().converged());
  const double expected = probed(one.report(), "end")[1];
  for (const char* slave : {"body", "other"}) {
    double last = 1;
    for (const int uniform : {0, 1, 2}) {
      const double off = std::abs(bending_of_cut_cantilever(slave, uniform) / expected - 1);
      show("slave {}, {} refinements: {:.3g} off\n", slave, uniform, off);
      EXPECT_LT(off, 0.75 * last);
      last = off;
    }
    EXPECT_LT(last, 1e-3);
  }
}

// Four blocks around a point, where all ties meet, and each is a master here and a slave there.
TEST(TiedBodies, PassThePatchTestAroundAPoint) {
  for (const int order : {1, 2}) {
    const std::string m = material(2, 0.3, order);
    std::string text = block("a", "[0, 0]", "[1, 1]", "[2, 3]", m) + block("b", "[1, 0]", "[2, 1]", "[3, 2]", m) +
                       block("c", "[0, 1]", "[1, 2]", "[4, 3]", m) + block("d", "[1, 1]", "[2, 2]", "[3, 5]", m);
    for (const auto& [body, where] : {std::pair{"a", "x == 0 || y == 0"}, std::pair{"b", "x == 2 || y == 0"},
                                      std::pair{"c", "x == 0 || y == 2"}, std::pair{"d", "x == 2 || y == 2"}})
      text += fix_where(body, where, R"(["0.01 * x + 0.02 * y", "-0.015 * x + 0.03 * y"])");
    text += glue("a", "right", "b", "left") + glue("c", "bottom", "a", "top") + glue("d", "left", "c", "right") +
            glue("b", "top", "d", "bottom");
    for (const char* body : {"a", "b", "c", "d"}) text += probe(std::string("at ") + body, body, "[1, 1]");
    Driver driver(scene_of(text + "[solver]\ntolerance = 1e-12\n" + refined(1)));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    for (const ProbeReport& at : report.last().probes) {
      EXPECT_NEAR(at.value[0], 0.03, 1e-11) << at.name;
      EXPECT_NEAR(at.value[1], 0.015, 1e-11) << at.name;
    }
    expect_balance(report.last(), 1e-10);
  }
}

// A block is glued to half of a bed and lies on the other half. Pulled up, it opens there; pressed down, it is as good
// as glued.
TEST(TiedBodies, MayTouchEachOtherBesideTheTie) {
  const auto solve = [](const char* pull, bool glued) {
    const std::string m = material(1, 0.3, 2);
    std::string text = block("bed", "[0, 0]", "[2, 0.5]", "[7, 2]", m) +
                       block("up", "[0, 0.5]", "[2, 1]", "[8, 2]", m) + fix("bed", "bottom", "[0, 0]") +
                       load("up", pull, "top") + probe("end", "up", "[2, 0.5]") + refined(1);
    const auto half = [](const char* type, const char* where) {
      return fmt::format(
          "[[obstacle]]\ntype = \"{}\"\nbody = \"up\"\nwhere = \"y == 0.5 && {}\"\nother = \"bed\"\n"
          "other_where = \"y == 0.5\"\nslave = \"body\"\n",
          type, where);
    };
    text += half("tied", "x <= 1") + half(glued ? "tied" : "elastic", "x >= 1");
    Driver driver(scene_of(text));
    driver.solve();
    return driver.report();
  };
  const Report opens = solve("[0, 0.001]", false), closed = solve("[0, -0.001]", false),
               glued = solve("[0, -0.001]", true);
  for (const Report* report : {&opens, &closed, &glued}) {
    ASSERT_TRUE(report->converged()) << report->reason();
    expect_balance(report->last(), 1e-9);
    for (const ContactReport& contact : report->last().contact) expect_opposite(contact, 1e-9);
  }
  EXPECT_EQ(opens.last().contact[1].nodes, 0);
  EXPECT_NEAR(opens.last().contact[0].force[1], -0.002, 1e-9);
  EXPECT_GT(closed.last().contact[1].nodes, 10);
  EXPECT_NEAR(closed.last().contact[0].force[1] + closed.last().contact[1].force[1], 0.002, 1e-9);
  EXPECT_NEAR(probed(closed, "end")[1], probed(glued, "end")[1], 0.05 * std::abs(probed(glued, "end")[1]));
}

// Rings glued around each other on meshes that do not match are a tube, whose pressure Lamé gives, and so does the
// interface: p = p_inner (b^2 / r^2 - 1) / (b^2 / a^2 - 1).
class TiedRings : public Folder {};
TEST_F(TiedRings, AreATube) {
  constexpr double a = 1, r = 1.5, b = 2, load = 0.01, pi = std::numbers::pi;
  for (const int order : {1, 2})
    for (const char* slave : {"body", "other"}) {
      const std::string m = material(1, 0.3, order);
      Driver driver(scene_of(
          sector(folder_, "outer", {.inner = r, .outer = b, .to = pi / 2, .along_radius = 2, .around = 9}, m) +
          sector(folder_, "inner", {.inner = a, .outer = r, .to = pi / 2, .along_radius = 2, .around = 7}, m) +
          fix("outer", "first", "[\"free\", 0]") + fix("inner", "first", "[\"free\", 0]") +
          fix("outer", "last", "[0, \"free\"]") + fix("inner", "last", "[0, \"free\"]") +
          fmt::format("[[load]]\nbody = \"inner\"\non = \"inner\"\nvalue = [\"{0} * x / hypot(x, y)\", \"{0} * y / "
                      "hypot(x, y)\"]\n",
                      load) +
          glue("outer", "inner", "inner", "outer", fmt::format("slave = \"{}\"\n", slave)) +
          refined(order == 1 ? 3 : 2)));
      const Report& report = driver.solve();
      ASSERT_TRUE(report.converged()) << report.reason();
      const double p = load * (b * b / (r * r) - 1) / (b * b / (a * a) - 1);
      // The resultant over a quarter along x is p r.
      show("order {}, slave {}: force {:.6g}, expected {:.6g}, {} cycles\n", order, slave,
           report.last().contact[0].force[0], p * r, report.last().summary.iterations);
      EXPECT_NEAR(report.last().contact[0].force[0], p * r, (order == 1 ? 2e-2 : 2e-3) * p * r);
      EXPECT_TRUE(report.warnings.empty()) << report.warnings.front().text;
    }
}

std::string apart(double gap, const std::string& more = "") {
  return block("lower", "[0, 0]", "[1, 0.5]", "[3, 2]") +
         block("upper", fmt::format("[0, {}]", 0.5 + gap), fmt::format("[1, {}]", 1 + gap), "[4, 3]") +
         fix("lower", "bottom", "[0, 0]") + load("upper", "[0, -0.01]", "top") +
         glue("upper", "bottom", "lower", "top", more);
}

TEST(TiedBodies, HaveToTouch) {
  for (const double gap : {0.05, -0.05}) {
    expect_error(apart(gap), Exit::input, "0.05 apart, or into each other");
    expect_error(apart(gap, "adjust = 0.04\n"), Exit::input, "0.05 apart, or into each other");
    Driver driver(scene_of(apart(gap, "adjust = 0.06\n")));
    ASSERT_TRUE(driver.solve().converged());
    EXPECT_NEAR(driver.report().last().contact[0].force[1], 0.01, 1e-9);
    ASSERT_EQ(driver.report().warnings.size(), 1u);
    EXPECT_EQ(driver.report().warnings.front().id, "tied-apart");
  }
  expect_error(apart(0.05, "adjust = 2\n"), Exit::input, "more than the longest edge");
  expect_error(apart(0, "renew = false\n"), Exit::input, "'renew' has no meaning");
  Driver exact(scene_of(apart(0)));
  ASSERT_TRUE(exact.solve().converged());
  EXPECT_TRUE(exact.report().warnings.empty());
}

TEST(TiedBodies, RefuseSidesThatDoNotFaceEachOther) {
  expect_error(block("lower", "[0, 0]", "[1, 0.5]", "[3, 2]") + block("upper", "[0, 0.5]", "[1, 1]", "[4, 3]") +
                   fix("lower", "bottom", "[0, 0]") + glue("upper", "top", "lower", "bottom"),
               Exit::input, "ties no node");
}

// A motion that only the tie stops.
TEST(TiedBodies, HoldEachOther) {
  Driver driver(scene_of(apart(0)));
  ASSERT_TRUE(driver.solve().converged());
  EXPECT_TRUE(driver.report().last().undetermined.empty());
  expect_error(block("lower", "[0, 0]", "[1, 0.5]", "[3, 2]") + block("upper", "[0, 0.5]", "[1, 1]", "[4, 3]") +
                   load("upper", "[0, -0.01]", "top") + fix("lower", "bottom", "[\"free\", 0]") +
                   load("lower", "[0.01, 0]", "right") + glue("upper", "bottom", "lower", "top"),
               Exit::no_solution, "translation along (1, 0)");
}

// Bodies of revolution: a rod in a sleeve, which is pulled out of it.
TEST(TiedBodies, OfRevolutionCarryTheWholeForce) {
  for (const int order : {1, 2})
    for (const char* slave : {"body", "other"}) {
      const std::string m = material(1, 0.3, order) + "plane = \"axisymmetric\"\n";
      Driver driver(scene_of(
          block("rod", "[0, 0]", "[0.5, 1]", "[3, 5]", m) + block("sleeve", "[0.5, 0]", "[1, 1]", "[2, 4]", m) +
          fix("sleeve", "right", "[0, 0]") + load("rod", "[0, 0.01]", "top") +
          glue("rod", "right", "sleeve", "left", fmt::format("slave = \"{}\"\n", slave)) + refined(1)));
      const Report& report = driver.solve();
      ASSERT_TRUE(report.converged()) << report.reason();
      EXPECT_NEAR(report.last().contact[0].force[1], -0.01 * std::numbers::pi * 0.25, 1e-9);
    }
}

// Nearly incompressible material has pressures of its own on both sides.
TEST(TiedBodies, OfRubberAreOneBody) {
  const std::string m = material(1, 0.499, 2);
  const auto solve = [](const std::string& text) {
    Driver driver(scene_of(text + refined(1)));
    driver.solve();
    return driver.report();
  };
  const Report one = solve(block("left", "[0, 0]", "[3, 1]", "[12, 4]", m) + fix("left", "left", "[0, 0]") +
                           load("left", "[0, -0.001]", "right") + probe("end", "left", "[3, 0.5]"));
  const Report two =
      solve(block("left", "[0, 0]", "[1.5, 1]", "[6, 4]", m) + block("right", "[1.5, 0]", "[3, 1]", "[7, 5]", m) +
            fix("left", "left", "[0, 0]") + load("right", "[0, -0.001]", "right") +
            glue("right", "left", "left", "right") + probe("end", "right", "[3, 0.5]"));
  ASSERT_TRUE(one.converged()) << one.reason();
  ASSERT_TRUE(two.converged()) << two.reason();
  EXPECT_NEAR(probed(two, "end")[1] / probed(one, "end")[1], 1, 2e-3);
  expect_balance(two.last(), 1e-9);
}

// Fixes at the ends leave nodes out of the tie, and not what is glued there.
TEST(TiedSide, IsAsLargeWhereFixesHoldItsEnds) {
  for (const int order : {1, 2}) {
    const auto sides = [](const char* body) {
      return fix(body, "left", "[0, \"free\"]") + fix(body, "right", "[0, \"free\"]");
    };
    Driver driver(scene_of(block("lower", "[0, 0]", "[1, 1]", "[3, 2]", material(1000, 0.3, order)) +
                           block("upper", "[0, 1]", "[1, 2]", "[4, 5]", material(1000, 0.3, order)) +
                           glue("lower", "top", "upper", "bottom", "slave = \"body\"\n") + sides("lower") +
                           sides("upper") + fix("lower", "bottom", "[\"free\", 0]") + load("upper", "[0, -7]", "top")));
    const ContactReport tie = driver.solve().last().contact[0];
    EXPECT_NEAR(tie.area, 1, 1e-12) << order;
    EXPECT_NEAR(tie.force[1], -7, 1e-6);
  }
}

TEST(TiedSide, LeavesNothingToTouchOnItsFaces) {
  expect_error(block("lower", "[0, 0]", "[1, 1]", "[3, 2]", material(1000)) +
                   block("upper", "[0, 1]", "[1, 2]", "[4, 5]", material(1000)) + fix("lower", "bottom", "[0, 0]") +
                   glue("lower", "top", "upper", "bottom") + pair("lower", "top", "upper", "bottom"),
               Exit::input, "obstacle.1: all of the slave is tied to the other body by test.toml");
}

}  // namespace
}  // namespace signorini::test
