// From results of bodies to what the user is told of them: contact, estimates, and several bodies as one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/scenes/tables.hpp"
#include "core/mesh/mirror.hpp"
#include "driver/components.hpp"
#include "driver/driver.hpp"
#include "driver/reports/contact_report.hpp"
#include "driver/reports/error_estimate.hpp"
#include "driver/reports/merge.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml", "."); }

/// A square on a plane through (2, 0, 0), with a force at two of the nodes of its bottom: results by hand.
struct Pressed {
  explicit Pressed(const std::string& more = "", Mesh<2> of = rectangle({0, 0}, {1, 1}, {1, 1}))
      : scene(scene_of(tables::block("b", "[0, 0]", "[1, 1]", "[1, 1]") +
                       tables::plane("b", "bottom", "[2, '0.5*t']", "[0, 1]") + more)),
        mesh(std::move(of)),
        nodes(mesh) {
    results.u.assign(mesh.points.size() * 2, 0);
    add(0, {1, 10});
    add(1, {-3, 20});
    ContactSummary<2>& sum = results.contact.obstacles.emplace_back();
    sum.nodes = 2;
    sum.area = 0.8;
    sum.force = {-2, 30};
    sum.tangential_force = {-2, 0};
    sum.max_pressure = 40;
    sum.dissipated = 0.5;
    sum.undetermined_force = 3;
    results.forces.contact = {{-2, 30}};
    results.deformed = {DeformedContact{0.1, 0.2, 0.3, 0, 1, 4}};
    results.between_nodes = {0.05};
    results.slaves.resize(1);
    results.across.obstacles = {0};
  }
  void add(Index vertex, const std::array<double, 2>& force, double area = 0.4, bool contact = true) {
    ContactNode<2>& node = results.contact.nodes.emplace_back();
    node.vertex = vertex;
    node.obstacle = 0;
    node.contact = contact;
    node.force = force;
    node.area = area;
  }
  ContactReport report(double t = 1) const { return contact_reports<2, 2>(scene, nodes, results, t, 0).at(0); }

  Scene scene;
  Mesh<2> mesh;
  Nodes<2> nodes;
  Results<2, 2> results;
};

TEST(ContactReport, HasForcesMomentsAndMeansOfTheNodes) {
  Pressed p;
  for (std::size_t v = 0; v < 4; ++v) p.results.u[2 * v + 1] = v == 0 ? -0.1 : v == 1 ? -0.3 : 0;
  p.add(2, {0, 0}, 0, false);  // open
  const ContactReport report = p.report();
  EXPECT_EQ(report.body, "b");
  EXPECT_EQ(report.obstacle, 0);
  EXPECT_EQ(report.nodes, 2);
  EXPECT_EQ(report.open_nodes, 1);
  EXPECT_EQ(report.area, 0.8);
  EXPECT_EQ(report.radius, 0.4);
  EXPECT_THAT(report.force, ElementsAre(-2, 30));
  EXPECT_THAT(report.normal_force, ElementsAre(0, 30));
  EXPECT_THAT(report.tangential_force, ElementsAre(-2, 0));
  EXPECT_THAT(report.moment_about, ElementsAre(2, 0.5));
  EXPECT_THAT(report.motion, ElementsAre(0, 0.5));
  // (x - 2) f_y - (y - 0.5) f_x
  EXPECT_THAT(report.moment, ElementsAre(testing::DoubleNear(-2 * 10 + 0.5 * 1 - 1 * 20 + 0.5 * -3, 1e-13)));
  EXPECT_NEAR(report.displacement[1], -0.2, 1e-15);
  EXPECT_EQ(report.penetration_between_nodes, 0.05);
  EXPECT_EQ(report.largest_penetration, 0.1);
  EXPECT_EQ(report.dissipated_in_step, 0.5);
  EXPECT_EQ(report.undetermined_force, 3);
  EXPECT_FALSE(report.pair);
  EXPECT_THAT(p.report(0).motion, ElementsAre(0, 0));
  p.results.deformed[0].reset();
  EXPECT_TRUE(std::isnan(p.report().largest_penetration));
}

// The whole of two halves: forces across the plane of symmetry cancel, and moments about a point on it.
TEST(ContactReport, IsThatOfTheWholeOfASymmetricBody) {
  Mesh<2> half = rectangle({2, 0}, {3, 1}, {1, 1});
  add_mirror(half, {0, 2}, "symmetry");
  Pressed p("", half);
  p.results.across.obstacles = {1};
  const ContactReport report = p.report();
  EXPECT_THAT(report.force, ElementsAre(0, 60));
  EXPECT_THAT(report.tangential_force, ElementsAre(0, 0));
  EXPECT_EQ(report.area, 1.6);
  EXPECT_EQ(report.dissipated, 1);
  EXPECT_NEAR(report.moment[0], 0, 1e-13);
  EXPECT_EQ(report.max_pressure, 40);
  EXPECT_EQ(report.nodes, 2);  // of what is meshed
  EXPECT_EQ(report.displacement[0], 0);
}

TEST(ContactReport, HasTheRadiusOfWhatItsAreaIs) {
  const auto radius = [](const std::string& plane, double area) {
    Pressed p;
    p.scene.bodies[0].plane = plane == "axisymmetric" ? Plane::axisymmetric : Plane::strain;
    p.results.contact.obstacles[0].area = area;
    return p.report().radius;
  };
  EXPECT_DOUBLE_EQ(radius("strain", 6), 3);
  EXPECT_DOUBLE_EQ(radius("axisymmetric", pi * 9), 3);
  // A scalar on all of a plane or of space: a disk, a ball.
  Scene scene = scene_of(tables::block("m", "[0, 0, 0]", "[1, 1, 1]", "[1, 1, 1]", "equation = 'diffusion'\n") +
                         tables::floor("m", "0"));
  const Mesh<3> mesh = box({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  Results<3, 1> results;
  results.u.assign(8, 0);
  results.contact.obstacles.resize(1);
  results.contact.obstacles[0].area = 4 * pi / 3 * 8;
  results.forces.contact.resize(1);
  results.deformed.resize(1);
  results.between_nodes = {nan};
  results.slaves.resize(1);
  results.across.obstacles = {0};
  const auto reports = contact_reports<3, 1>(scene, Nodes<3>(mesh), results, 1, 0);
  EXPECT_NEAR(reports.at(0).radius, 2, 1e-14);
  EXPECT_TRUE(reports[0].moment.empty());
}

// The body that the scene names first may be the master: its forces are the counterforces then.
TEST(ContactReport, TellsForcesOnBothBodies) {
  for (const bool exchanged : {false, true}) {
    Pressed p;
    p.scene.obstacles[0].other = "c";
    p.results.slaves = {{exchanged, "softer"}};
    NodalForce<2>& back = p.results.counterforces.emplace_back();
    back.node = 3;
    back.obstacle = 0;
    back.force = {2, -30};
    const ContactForces<2> forces = contact_forces(p.results);
    EXPECT_EQ(forces.on_body[0], (std::array<double, 2>{exchanged ? 2.0 : -2.0, exchanged ? -30.0 : 30.0}));
    EXPECT_EQ(forces.on_other[0], (std::array<double, 2>{exchanged ? -2.0 : 2.0, exchanged ? 30.0 : -30.0}));
    const ContactReport report = p.report();
    ASSERT_TRUE(report.pair);
    EXPECT_EQ(report.pair->slave, exchanged ? "c" : "b");
    EXPECT_EQ(report.pair->master, exchanged ? "b" : "c");
    EXPECT_EQ(report.pair->reason, "softer");
    EXPECT_EQ(report.force, (std::vector<double>(forces.on_body[0].begin(), forces.on_body[0].end())));
    EXPECT_EQ(report.pair->force, (std::vector<double>(forces.on_other[0].begin(), forces.on_other[0].end())));
    EXPECT_EQ(report.normal_force[1], exchanged ? -30 : 30);
    const double of_slave = -2 * 10 + 0.5 * 1 - 1 * 20 + 0.5 * -3, of_master = -1 * -30 - 0.5 * 2;
    EXPECT_NEAR(report.moment[0], exchanged ? of_master : of_slave, 1e-13);
    EXPECT_NEAR(report.pair->moment[0], exchanged ? of_slave : of_master, 1e-13);
  }
}

EstimateReport estimate(double scale, bool guaranteed, std::vector<std::string> reasons) {
  EstimateReport out;
  out.lower = 1 * scale, out.upper = out.estimated = 2 * scale, out.energy = 100 * scale, out.seconds = scale;
  out.guaranteed = guaranteed, out.reasons = std::move(reasons);
  out.parts = {0.1 * scale, 0.2 * scale, 0.3 * scale, 0.4 * scale, 0.5 * scale, 0.6 * scale};
  return out;
}

TEST(ErrorEstimate, AddsUpBodies) {
  EXPECT_FALSE(added_up({}));
  EXPECT_FALSE(added_up({estimate(1, true, {}), std::nullopt}));
  const auto all = added_up({estimate(1, true, {}), estimate(3, false, {"a", "b"}), estimate(2, true, {"b"})});
  ASSERT_TRUE(all);
  EXPECT_DOUBLE_EQ(all->lower, 6);
  EXPECT_DOUBLE_EQ(all->upper, 12);
  EXPECT_DOUBLE_EQ(all->estimated, 12);
  EXPECT_DOUBLE_EQ(all->energy, 600);
  EXPECT_FALSE(all->guaranteed);
  EXPECT_THAT(all->reasons, ElementsAre("a", "b"));
  EXPECT_NEAR(all->parts.discretisation, 0.6, 1e-15);
  EXPECT_NEAR(all->parts.friction, 3.6, 1e-15);
  EXPECT_TRUE(added_up({estimate(1, true, {}), estimate(1, true, {})})->guaranteed);
}

TEST(ErrorEstimate, OfAWholeIsThatOfItsCopies) {
  Estimate of;
  static_cast<EstimateReport&>(of) = estimate(1, true, {});
  const Estimate whole = of_whole(of, 4);
  EXPECT_EQ(whole.lower, 4);
  EXPECT_EQ(whole.upper, 8);
  EXPECT_EQ(whole.estimated, 8);
  EXPECT_EQ(whole.relative_upper(), of.relative_upper());
  EXPECT_DOUBLE_EQ(whole.parts.geometry, 2);
}

TEST(ErrorEstimate, IsToldInPercent) {
  EXPECT_EQ(error_text(estimate(1, true, {})), "energy error between 1 % and 2 %, guaranteed");
  EXPECT_EQ(error_text(estimate(7, false, {"x", "y"})), "energy error between 1 % and 2 %, not guaranteed: x; y");
  EstimateReport unknown = estimate(1, false, {"friction"});
  unknown.upper = nan;
  EXPECT_EQ(error_text(unknown), "energy error estimated as 2 %, not guaranteed: friction");
  unknown.estimated = nan;
  EXPECT_EQ(error_text(unknown), "energy error not known: friction");
}

TEST(ErrorEstimate, SolvesRoughly) {
  const Registry registry = all_components();
  Model<1> model;
  model.fixes.push_back({on("boundary"), {Field(0)}});
  model.loads.push_back({{}, {Field(1)}});
  const auto problem = discretize<2, 1>(cube<2>(0, 1, 30), model).problem;
  std::vector<double> x(problem.b.size(), 0);
  ASSERT_TRUE(rough_solve<1>(registry)(problem, x));
  const Eigen::VectorXd r = vector(problem.b) - sparse(problem.A) * vector(x);
  EXPECT_LT(r.norm(), 1e-3 * vector(problem.b).norm());
  EXPECT_GT(r.norm(), 1e-9 * vector(problem.b).norm());  // not better than that
}

/// One body's step, with so many cycles.
StepReport step(const std::string& name, int iterations, int obstacle, Outcome outcome = Outcome::converged) {
  StepReport out;
  Summary& s = out.summary;
  s.outcome = outcome;
  s.reason = "because";
  s.iterations = iterations;
  s.residual = 1e-9 * iterations;
  s.algebraic_error = 1e-8 / iterations;
  s.energy = -iterations;
  s.rate = 0.1 * iterations;
  s.setup_seconds = 1;
  s.options.method = name == "a" ? "monotone" : "newton";
  s.finest_level = iterations;
  for (int k = 0; k < iterations; ++k) {
    s.level_unknowns.push_back(10 * (k + 1));  // as many levels as cycles
    s.history.push_back({k + 1, 1, 1, 1, 0, 0, std::vector<LevelReport>(iterations), 0});
  }
  s.stages.resize(1);
  ContactReport& contact = out.contact.emplace_back();
  contact.obstacle = obstacle;
  out.applied = {{obstacle, {1}}};
  out.reactions = {{obstacle, {2}}};
  out.probes = {{"probe of " + name, name, {3}}};
  out.balance.emplace_back().body = name;
  out.undetermined = {name};
  out.estimate = estimate(1, true, {});
  out.bodies = {{name, s}};
  return out;
}

TEST(Merge, AddsUpWhatBodiesTakeAndCountsTheWorst) {
  Scene scene;
  for (const char* name : {"probe of b", "probe of a"}) scene.probes.emplace_back().name = name;
  const StepReport all = merged(scene, {step("a", 2, 1), step("b", 3, 0, Outcome::iteration_limit)});
  const Summary& s = all.summary;
  EXPECT_EQ(s.outcome, Outcome::iteration_limit);
  EXPECT_EQ(s.reason, "a: because; b: because");
  EXPECT_EQ(s.iterations, 5);
  EXPECT_EQ(s.energy, -5);
  EXPECT_EQ(s.setup_seconds, 2);
  EXPECT_DOUBLE_EQ(s.residual, 3e-9);
  EXPECT_DOUBLE_EQ(s.algebraic_error, 5e-9);
  EXPECT_DOUBLE_EQ(s.rate, 0.3);
  EXPECT_EQ(s.options.method, "monotone; newton");
  EXPECT_EQ(s.finest_level, 3);
  EXPECT_THAT(s.level_unknowns, ElementsAre(10, 30, 50));  // counted from the finest
  ASSERT_EQ(s.history.size(), 5u);
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(s.history[k].iteration, k + 1);
    EXPECT_EQ(s.history[k].stage, k < 2 ? 0u : 1u);
    EXPECT_EQ(s.history[k].levels.size(), 3u);  // coarser levels that a body has not are idle
  }
  EXPECT_EQ(s.stages.size(), 2u);
  EXPECT_EQ(all.bodies.size(), 2u);
  EXPECT_EQ(all.bodies[0].summary.iterations, 2);
  // In the order of the scene's tables.
  EXPECT_EQ(all.contact[0].obstacle, 0);
  EXPECT_EQ(all.applied[0].number, 0);
  EXPECT_EQ(all.reactions[1].number, 1);
  EXPECT_EQ(all.probes[0].name, "probe of b");
  EXPECT_THAT(all.undetermined, ElementsAre("a", "b"));
  EXPECT_DOUBLE_EQ(all.estimate->upper, 4);
}

TEST(Merge, KeepsRoundingForASolution) {
  const auto outcome = [](Outcome a, Outcome b) {
    return merged(Scene(), {step("a", 1, 0, a), step("b", 1, 1, b)}).summary.outcome;
  };
  EXPECT_EQ(outcome(Outcome::converged, Outcome::rounding), Outcome::rounding);
  EXPECT_EQ(outcome(Outcome::rounding, Outcome::converged), Outcome::rounding);
  EXPECT_EQ(outcome(Outcome::stuck, Outcome::rounding), Outcome::stuck);
}

TEST(Merge, LeavesOneBodyAsItIs) {
  const StepReport one = merged(Scene(), {step("a", 2, 0)});
  EXPECT_EQ(one.summary.reason, "because");
  EXPECT_EQ(one.summary.level_unknowns.size(), 2u);
  StepReport without = step("b", 1, 1);
  without.estimate.reset();
  EXPECT_FALSE(merged(Scene(), {step("a", 2, 0), without}).estimate);
}

// A disk under pressure shrinks evenly: a probe on the circle, between the nodes, reads the displacement there, and not
// that of the chord, which is off by the height of the arc.
TEST(Probes, on_a_curved_boundary_read_there) {
  for (const int order : {1, 2}) {
    Driver driver(scene_of(
        fmt::format("[[body]]\nname = \"b\"\nshape = \"disk\"\ncenter = [0, 0]\nradius = 1\nsize = 0.6\nyoung = 1000\n"
                    "poisson = 0.3\norder = {}\n[[load]]\nbody = \"b\"\non = \"boundary\"\npressure = "
                    "3\n[[spring]]\nbody = \"b\"\non = \"boundary\"\nstiffness = 1e-3\n"
                    "[[probe]]\nname = \"p\"\nbody = \"b\"\nat = [{:.17g}, {:.17g}]\n[solver]\ntolerance = 1e-12\n",
                    order, std::cos(0.7), std::sin(0.7))));
    const std::vector<double> value = driver.solve().last().probes[0].value;
    const double shrunk = 3 * 1.3 * 0.4 / 1000;  // p (1 + nu) (1 - 2 nu) / E
    EXPECT_NEAR(std::hypot(value[0], value[1]) / shrunk, 1, order == 1 ? 1e-2 : 1e-3) << order;
  }
}

}  // namespace
}  // namespace signorini::test
