// Pressure that acts only where contact is open, against equilibrium and formulas by hand.
#include <gmock/gmock.h>

#include <numbers>

#include "core/fem/recovery/joint_pressure.hpp"
#include "tests/bodies/scenes.hpp"

namespace signorini::test {
namespace {

using tables::block, tables::fix, tables::load;

const std::string exact = "[solver]\ntolerance = 1e-11\n";

std::string seal(const std::string& body, const std::string& on, const std::string& pressure,
                 const std::string& from = "") {
  return fmt::format("[[load]]\nbody = \"{}\"\non = \"{}\"\npressure = {}\nwhere_open = true\n{}", body, on, pressure,
                     from.empty() ? "" : fmt::format("from = \"{}\"\n", from));
}

StepReport solved(const std::string& text) {
  Driver driver(scene_of(text + exact));
  EXPECT_TRUE(driver.solve().converged()) << driver.report().reason();
  return driver.report().last();
}

// Nodes that come and go would do so for ever: from the first time on that they come back, what is wetted only grows.
TEST(Spreading, ComesToRest) {
  Spreading spreading(Wetted{{0, 0, 0}});
  EXPECT_TRUE(spreading.take({{1, 0, 0}}));
  EXPECT_TRUE(spreading.take({{1, 1, 0}}));
  EXPECT_EQ(spreading.now(), (Wetted{{1, 1, 0}}));
  EXPECT_TRUE(spreading.take({{1, 0, 0}}));
  EXPECT_EQ(spreading.shut(), 1);
  EXPECT_TRUE(spreading.take({{1, 1, 0}}));
  EXPECT_EQ(spreading.shut(), 0);
  EXPECT_FALSE(spreading.take({{1, 0, 0}}));
  EXPECT_EQ(spreading.now(), (Wetted{{1, 1, 0}}));
  EXPECT_EQ(spreading.shut(), 1);
}

struct Case {
  int dimension, order;
  bool axisymmetric = false;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return fmt::format("In{}DOrder{}{}", info.param.dimension, info.param.order,
                     info.param.axisymmetric ? "OfRevolution" : "");
}

/// A block of 2 by 1 (by 1), pressed by 1e-4 on a rigid floor that has a hollow.
class OpenJoint : public testing::TestWithParam<Case> {
 protected:
  static constexpr double node = 0.125;  // where elements begin is known up to one
  static constexpr double q = 1e-4, p = 3e-5;
  int D() const { return GetParam().dimension; }
  std::string material() const {
    return fmt::format("{}order = {}\nyoung = 2\npoisson = 0.3\n",
                       GetParam().axisymmetric ? "plane = \"axisymmetric\"\n" : "", GetParam().order);
  }
  /// @param hollow its depth, an expression
  StepReport on_floor(const std::string& hollow, const std::string& from = "") const {
    const bool plane = D() == 2;
    return solved(
        (plane ? block("b", "[0, 0]", "[2, 1]", "[8, 4]", material()) +
                     (GetParam().axisymmetric ? "" : fix("b", "left", "[0, \"free\"]"))
               : block("b", "[0, 0, 0]", "[2, 1, 1]", "[8, 2, 4]", material()) +
                     fix("b", "left", "[0, \"free\", \"free\"]") + fix("b", "front", "[\"free\", 0, \"free\"]")) +
        fmt::format("[[load]]\nbody = \"b\"\non = \"top\"\npressure = {}\n", q) +
        seal("b", "bottom", fmt::format("{}", p), from) +
        fmt::format("[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\non = \"bottom\"\nshape = \"expression\"\n"
                    "distance = \"{} + {}\"\nnormal = {}\n[refine]\nuniform = 1\n",
                    plane ? "y" : "z", hollow, plane ? "[0, 1]" : "[0, 0, 1]"));
  }
  double within() const { return GetParam().axisymmetric ? 2 * std::numbers::pi * node : (D() - 1) * node; }
  double area(double from, double to) const {  // of the floor between these x
    return GetParam().axisymmetric ? std::numbers::pi * (to * to - from * from) : to - from;
  }
  void expect_uplift(const StepReport& step, double wetted, double within) const {
    ASSERT_TRUE(step.applied.at(1).open_area);
    const double found = *step.applied[1].open_area, up = D() - 1;
    EXPECT_NEAR(found, wetted, within);
    EXPECT_NEAR(step.applied[1].force.at(static_cast<std::size_t>(up)), p * found, 1e-12);
    EXPECT_NEAR(step.contact[0].force.at(static_cast<std::size_t>(up)), q * area(0, 2) - p * found, 1e-10);
    EXPECT_NEAR(step.balance[0].sum().at(static_cast<std::size_t>(up)), 0, 1e-10);
  }
};

TEST_P(OpenJoint, is_pressed_where_it_is_open) {
  const std::string ramp = "0.1 * max(0, x - 1)";
  expect_uplift(on_floor(ramp), area(1, 2), within());
  expect_uplift(on_floor(ramp, "right"), area(1, 2), within());
}

TEST_P(OpenJoint, is_dry_where_contact_shuts_it_off) {
  const std::string pocket = "0.1 * max(0, 0.5 - abs(x - 1))";
  expect_uplift(on_floor(pocket), area(0.5, 1.5), 2 * within());
  expect_uplift(on_floor(pocket, "right"), 0, 0);
}

INSTANTIATE_TEST_SUITE_P(Open, OpenJoint,
                         testing::Values(Case{2, 1}, Case{2, 2}, Case{3, 1}, Case{3, 2}, Case{2, 1, true},
                                         Case{2, 2, true}),
                         name_of);

/// A column of height 1 between smooth walls, whose modulus is 2: its top is moved by the expression.
std::vector<StepReport> column(const std::string& top, const std::string& at) {
  Driver driver(scene_of(block("c", "[0, 0]", "[0.5, 1]", "[2, 4]", "young = 2\npoisson = 0\n") +
                         fix("c", "left", "[0, \"free\"]") + fix("c", "right", "[0, \"free\"]") +
                         fix("c", "top", fmt::format("[0, \"{}\"]", top)) + seal("c", "bottom", "0.01") +
                         tables::plane("c", "bottom", "[0, 0]", "[0, 1]") + "[steps]\nat = " + at + "\n" + exact));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  return report.steps;
}

// p H / E = 0.005 is what the pressure shortens the column by.
TEST(SealColumn, opens_when_it_is_relieved_and_shuts_when_it_is_pressed_more_than_the_fluid_does) {
  const auto steps = column("t < 0.3 ? -0.002 : t < 0.6 ? 0.001 : t < 0.9 ? -0.002 : -0.008", "[0.25, 0.5, 0.75, 1]");
  ASSERT_EQ(steps.size(), 4);
  const auto contact = [&](int k) { return steps[static_cast<std::size_t>(k)].contact[0].force[1]; };
  const auto fluid = [&](int k) { return steps[static_cast<std::size_t>(k)].applied[0].force[1]; };
  const auto held = [&](int k) { return steps[static_cast<std::size_t>(k)].reactions[2].force[1]; };
  EXPECT_NEAR(contact(0), 2 * 0.002 * 0.5, 1e-10);  // shut: no fluid enters
  EXPECT_EQ(fluid(0), 0);
  for (const int k : {1, 2}) {  // open, and kept open by the fluid
    EXPECT_NEAR(fluid(k), 0.01 * 0.5, 1e-12);
    EXPECT_EQ(contact(k), 0);
    EXPECT_NEAR(held(k), -0.01 * 0.5, 1e-10);
  }
  EXPECT_NEAR(contact(3), 2 * 0.008 * 0.5, 1e-10);  // shut again
  EXPECT_EQ(fluid(3), 0);
}

// What presses less than the fluid does gives way, where the fluid gets to it: here from the left.
TEST(SealColumn, gives_way_from_its_edge_where_the_fluid_presses_more) {
  for (const auto& [pressed, leaks] : {std::pair(0.004, true), std::pair(0.006, false)}) {
    const StepReport step =
        solved(block("c", "[0, 0]", "[0.5, 1]", "[2, 4]", "young = 2\npoisson = 0\n") +
               fix("c", "top", fmt::format("[0, {}]", -pressed)) + fix("c", "left", "[0, \"free\"]") +
               fix("c", "right", "[0, \"free\"]") + seal("c", "bottom", "0.01", "left") +
               tables::plane("c", "bottom", "[0, 0]", "[0, 1]"));
    EXPECT_NEAR(*step.applied[0].open_area, leaks ? 0.5 : 0, 1e-12) << pressed;
    EXPECT_NEAR(step.contact[0].force[1], leaks ? 0 : 2 * pressed * 0.5, 1e-9) << pressed;
  }
}

/// Of a dam with the uplift pressure p, see apps/scenes/jobs/dam_uplift.toml.
double open_length(double p) {
  const double W = 0.024 * 200, M = 0.01 * std::pow(18, 3) / 6;
  return 10 - 3 * (W * 5 - M - 50 * p) / (W - 10 * p);
}

TEST(Dam, joint_opens_as_far_as_by_hand_with_and_without_uplift) {
  for (const double p : {0.0, 0.18}) {
    const std::vector<std::string> pressure{fmt::format("load.2.pressure={}", p), "solver.tolerance=1e-9"};
    Driver driver(read_scene(SIGNORINI_SOURCE_DIR "/apps/scenes/jobs/dam_uplift.toml", pressure));
    ASSERT_TRUE(driver.solve().converged()) << driver.report().reason();
    const StepReport& step = driver.report().last();
    const double open = *step.applied[2].open_area;
    show("p = {}: open {}, by hand {}, {} cycles, force {}\n", p, open, open_length(p), step.summary.iterations,
         step.contact[0].force[1]);
    EXPECT_NEAR(open, open_length(p), 0.1);
    EXPECT_NEAR(step.applied[2].force[1], -p * open, 1e-9);  // on the bed
    EXPECT_NEAR(step.contact[0].force[1], 4.8 - p * open, 1e-6);
    expect_balance(step, 1e-6);
    EXPECT_NEAR(step.balance[0].applied[1], -4.8 + p * open, 1e-9);  // the dam is lifted, too
  }
}

/// Blocks on each other, pressed so far beside the middle that the joint opens.
std::string leaning(int order, const std::string& more) {
  const std::string of = fmt::format("order = {}\nyoung = {{}}\npoisson = 0.2\n", order);
  return block("lower", "[0, 0, 0]", "[2, 1, 0.5]", "[5, 2, 1]", fmt::format(fmt::runtime(of), 1)) +
         block("upper", "[0, 0, 0.5]", "[2, 1, 3.5]", "[4, 3, 6]", fmt::format(fmt::runtime(of), 2)) +
         fix("lower", "bottom", "[0, 0, 0]") + fix("upper", "left", "[\"free\", 0, \"free\"]") +
         fix("upper", "bottom", "[0, \"free\", \"free\"]") +
         "[[load]]\nbody = \"upper\"\non = \"top\"\nforce = [0, 0, -0.002]\nabout = [1.5, 0.5, 3.5]\n" +
         pair("upper", "bottom", "lower", "top") + more + "[refine]\nuniform = 1\n";
}

TEST(OpenJointOfTwoBodies, pushes_both_apart_in_balance) {
  for (const int order : {1, 2}) {
    const StepReport step = solved(leaning(order, seal("upper", "bottom", "4e-4", "left")));
    const double open = *step.applied[1].open_area;
    show("order {}: open {}, {} cycles\n", order, open, step.summary.iterations);
    EXPECT_GT(open, 0.3);
    EXPECT_NEAR(step.applied[1].force[2], 4e-4 * open, 1e-12);
    EXPECT_NEAR(step.balance[0].applied[2], -4e-4 * open, 1e-12);
    EXPECT_NEAR(step.contact[0].force[2], 0.002 - 4e-4 * open, 1e-9);
    expect_balance(step, 1e-9);
    expect_opposite(step.contact[0]);
    EXPECT_EQ(step.contact[0].pair->slave, "upper");
  }
}

// A lid that hangs over its seat on both sides: the seat is pressed where it is in front of the lid, and nowhere else.
TEST(OpenJointOfTwoBodies, presses_the_other_one_where_it_is) {
  for (const int order : {1, 2}) {
    const std::string of = fmt::format("order = {}\nyoung = 100\npoisson = 0.3\n", order);
    const StepReport step = solved(
        block("lid", "[0, 10]", "[40, 18]", "[20, 4]", of) + block("seat", "[10.3, 0]", "[30.6, 10]", "[13, 5]", of) +
        fix("lid", "top", "[0, 0]") + fix("seat", "bottom", "[0, 0]") + seal("lid", "bottom", "1e-4") +
        pair("lid", "bottom", "seat", "top", "gap = 0.01\n"));
    EXPECT_NEAR(step.balance[0].applied[1], 1e-4 * 40, 1e-12);
    // Of quadratic elements, where it ends within a face, the shares of nodes are not exactly its part of them.
    EXPECT_NEAR(step.balance[1].applied[1], -1e-4 * 20.3, order == 1 ? 1e-12 : 0.002 * 1e-4 * 20.3);
  }
}

TEST(OpenJointOfTwoBodies, of_revolution) {
  const std::string plane = "plane = \"axisymmetric\"\nyoung = 2\npoisson = 0.3\n";
  const StepReport step =
      solved(block("upper", "[0, 1]", "[2, 2]", "[8, 4]", plane) +
             "[[body]]\nname = \"lower\"\nshape = \"polygon\"\npoints = [[0, 0], [2, 0], [2, 1], [1, 1], [0, 0.9]]\n"
             "size = 0.25\n" +
             plane + fix("lower", "edge0", "[\"free\", 0]") +
             "[[load]]\nbody = \"upper\"\non = \"top\"\npressure = 1e-4\n" + seal("upper", "bottom", "3e-5") +
             "[[obstacle]]\ntype = \"elastic\"\nbody = \"upper\"\non = \"bottom\"\nother = \"lower\"\n");
  const double open = *step.applied[1].open_area;
  EXPECT_NEAR(open, std::numbers::pi, 0.8);  // where the slope begins, within an element
  EXPECT_NEAR(step.contact[0].force[1], 4 * std::numbers::pi * 1e-4 - 3e-5 * open, 1e-9);
  for (const BalanceReport& body : step.balance) EXPECT_NEAR(body.sum()[1], 0, 1e-9) << body.body;
}

TEST(OpenJoint, is_refused_where_it_means_nothing) {
  const std::string body = block("b", "[0, 0]", "[1, 1]", "[2, 2]") + fix("b", "top", "[0, 0]");
  const std::string floor = tables::plane("b", "bottom", "[0, 0]", "[0, 1]");
  expect_error(body + seal("b", "bottom", "1"), Exit::input, "no obstacle acts on body 'b'");
  expect_error(body + floor + "[[load]]\nbody = \"b\"\non = \"bottom\"\nvalue = [0, 1]\nwhere_open = true\n",
               Exit::input, "belongs to 'pressure'");
  expect_error(body + floor + "[[load]]\nbody = \"b\"\non = \"bottom\"\npressure = 1\nfrom = \"left\"\n", Exit::input,
               "'from' has no meaning without 'where_open'");
  expect_error(body + floor + seal("b", "bottom", "1", "top"), Exit::input, "no node in common");
  expect_error(body + floor + seal("b", "bottom", "1") + "[solver]\nbodies = \"dirichlet-neumann\"\n", Exit::input,
               "dirichlet-neumann");
}

TEST(OpenJoint, of_a_master_is_refused) {
  expect_error(leaning(1, "slave = \"body\"\n" + seal("lower", "top", "1")), Exit::input, "those of a master");
}

}  // namespace
}  // namespace signorini::test
