// One body from its scene to its results, and two that touch each other solved in turns.
#include "driver/body_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/scenes/tables.hpp"
#include "core/base/error.hpp"
#include "driver/components.hpp"
#include "driver/dirichlet_neumann.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/problem.hpp"
#include "driver/scene/touching_bodies.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// All that a run keeps references to.
struct Setting {
  explicit Setting(const std::string& text) : scene(with_touching_bodies(parse_scene(text, "test.toml", "."))) {
    load_plugins(scene, registry);
  }
  Scene scene;
  Registry registry = all_components();
  const Progress quiet;
  Times times;
  Warnings warnings;
};

const LoadStep whole{1, 0, 1};

template <class Work>
std::string refused(const Work& work, Exit status = Exit::input) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status);
    return error.what();
  }
  return "";
}

/// Guided at its sides and pushed down from the top onto a plane: uniform strain in closed form.
std::string pressed(const std::string& depth = "-0.01") {
  return tables::block("b", "[0, 0]", "[1, 1]", "[2, 2]", "order = 1\nyoung = 2\npoisson = 0.25\n") +
         tables::fix("b", "top", "[\"free\", \"" + depth + "\"]") + tables::fix("b", "left", "[0, \"free\"]") +
         tables::fix("b", "right", "[0, \"free\"]") + tables::plane("b", "bottom", "[0, 0]", "[0, 1]") +
         tables::probe("middle", "b", "[0.5, 0.5]") + "[refine]\nuniform = 1\n";
}

TEST(BodyRun, SolvesAStep) {
  Setting of(pressed("-0.01*t"));
  BodyRun<2, 2> run(of.scene, 0, of.registry, of.quiet, of.times, of.warnings);
  EXPECT_EQ(run.body().name, "b");
  EXPECT_EQ(run.hierarchy().levels.size(), 2u);
  EXPECT_EQ(run.numbers(), 50u);
  run.find_probes();
  run.begin(0);
  const StepReport report = run.solve(whole, of.warnings);
  ASSERT_TRUE(report.summary.converged());
  // sigma_yy = (lambda + 2 mu) strain, with E = 2 and nu = 1/4: lambda = mu = 0.8
  const double stress = 2.4 * -0.01;
  EXPECT_NEAR(report.contact.at(0).force[1], -stress, 1e-9);
  EXPECT_NEAR(report.contact[0].max_pressure, -stress, 1e-9);
  EXPECT_NEAR(report.probes.at(0).value[1], -0.005, 1e-10);
  const std::vector<double> u = run.solution();
  for (std::size_t v = 0; v < run.mesh().points.size(); ++v)
    EXPECT_NEAR(u[2 * v + 1], -0.01 * run.mesh().points[v][1], 1e-10);
  for (const Stress& s : run.stress()) {
    EXPECT_NEAR(s[1], stress, 1e-8);
    EXPECT_NEAR(s[0], 0.8 * -0.01, 1e-8);
  }
  EXPECT_FALSE(run.remembers());
  EXPECT_FALSE(run.depends_on_step());
  EXPECT_EQ(run.veto_against_cutting(), nullptr);
  EXPECT_EQ(run.doubt_of_friction(whole, 1, false).reason, nullptr);
  EXPECT_GT(of.times.assemblies.stiffness, 0);
  // From the accepted one the next step has little to do, and results are those of that step.
  run.accept();
  const StepReport half = run.solve({1, 0, 0.5}, of.warnings);
  EXPECT_NEAR(half.contact.at(0).force[1], -stress / 2, 1e-9);
  run.forget_matrices();
  EXPECT_NEAR(run.solve(whole, of.warnings).contact.at(0).force[1], -stress, 1e-9);
}

TEST(BodyRun, StartsFromWhatItIsGiven) {
  Setting of(pressed());
  BodyRun<2, 2> run(of.scene, 0, of.registry, of.quiet, of.times, of.warnings);
  run.begin(0);
  EXPECT_THAT(refused([&] { run.start_from({1, 2}); }, Exit::usage), HasSubstr("2 numbers, expected 50"));
  std::vector<double> u(50, 0);
  u[7] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refused([&] { run.start_from(u); }, Exit::usage), HasSubstr("not finite"));
  for (std::size_t v = 0; v < 25; ++v) u[2 * v] = 0, u[2 * v + 1] = -0.01 * run.mesh().points[v][1];
  run.start_from(u);
  const StepReport report = run.solve(whole, of.warnings);
  EXPECT_TRUE(report.summary.converged());
  EXPECT_LE(report.summary.iterations, 1);  // it is the solution
}

TEST(BodyRun, RefusesAProbeOutside) {
  Setting of(pressed() + tables::probe("outside", "b", "[3, 0]"));
  BodyRun<2, 2> run(of.scene, 0, of.registry, of.quiet, of.times, of.warnings);
  EXPECT_THAT(refused([&] { run.find_probes(); }), HasSubstr("probe"));
}

TEST(BodyRun, RefinesWhereItsErrorIs) {
  Setting of(tables::block("m", "[0, 0]", "[1, 1]", "[4, 4]", "equation = 'diffusion'\n") +
             tables::fix("m", "boundary", "0") + tables::load("m", "-10") + tables::floor("m", "-0.2") +
             "[refine]\nadaptive = true\n[solver]\nestimate = \"true\"\n");
  BodyRun<2, 1> run(of.scene, 0, of.registry, of.quiet, of.times, of.warnings);
  run.begin(0);
  ASSERT_TRUE(run.solve(whole, of.warnings).summary.converged());
  ASSERT_EQ(run.estimate_of_element().size(), run.mesh().elements.size());
  const Estimate before = run.estimate();
  EXPECT_GT(before.upper, before.lower);
  const std::size_t elements = run.mesh().elements.size();
  const auto finer = run.refined(2, of.warnings);
  EXPECT_GT(finer->mesh().elements.size(), elements);
  finer->begin(0);
  ASSERT_TRUE(finer->solve(whole, of.warnings).summary.converged());
  EXPECT_LT(finer->estimate().upper, before.upper);
}

/// A stiff block on a soft one that is held.
std::string pair(const std::string& solver, const std::string& obstacle = "type = \"elastic\"\n", int order = 1) {
  const auto body = [&](const char* name, const char* from, const char* to, const char* cells, double young) {
    return tables::block(name, from, to, cells, fmt::format("order = {}\nyoung = {}\npoisson = 0.3\n", order, young));
  };
  return body("soft", "[0, 0]", "[3, 1]", "[6, 2]", 1) + body("hard", "[1, 1.01]", "[2, 2]", "[3, 3]", 5) +
         tables::fix("soft", "bottom", "[0, 0]") + tables::fix("hard", "top", "[0.01, -0.05]") +
         "[[obstacle]]\nbody = \"soft\"\non = \"top\"\nother = \"hard\"\nother_on = \"bottom\"\n" + obstacle +
         "[refine]\nuniform = 1\n[solver]\n" + solver;
}

// Turns between the bodies come to the solution that both have together.
TEST(DirichletNeumann, ComesToTheJointSolution) {
  std::vector<std::vector<double>> u;
  std::vector<double> force, energy;
  for (const char* bodies : {"jumps", "dirichlet-neumann"}) {
    Setting of(pair(fmt::format("bodies = \"{}\"\ntolerance = 1e-9\n", bodies), "type = \"elastic\"\nrenew = false\n"));
    ASSERT_EQ(of.scene.bodies.size(), 1u);
    BodyRun<2, 2> run(of.scene, 0, of.registry, of.quiet, of.times, of.warnings);
    run.begin(0);
    const StepReport report = run.solve(whole, of.warnings);
    ASSERT_TRUE(report.summary.converged()) << report.summary.reason;
    u.push_back(run.solution());
    force.push_back(report.contact.at(0).force[1]);
    energy.push_back(report.summary.energy);
    EXPECT_NEAR(report.contact[0].pair->force[1], -report.contact[0].force[1], 1e-8);
  }
  ASSERT_EQ(u[0].size(), u[1].size());
  for (std::size_t i = 0; i < u[0].size(); ++i) EXPECT_NEAR(u[0][i], u[1][i], 1e-7);
  EXPECT_LT(force[0], -1e-3);
  EXPECT_NEAR(force[1], force[0], 1e-6 * std::abs(force[0]));
  EXPECT_NEAR(energy[1], energy[0], 1e-6 * std::abs(energy[0]));
}

// The same by itself, without a run.
TEST(DirichletNeumann, CountsAllCyclesForTheLimit) {
  Setting of(pair("bodies = \"dirichlet-neumann\"\nmax_iterations = 2\n"));
  const MeshHierarchy<2> joint = build_hierarchy<2>(of.scene, 2);
  DirichletNeumann<2> turns(of.scene, 0, joint, of.registry, of.quiet, of.times);
  Model<2> model = build_model<2>(of.scene, 2, of.registry, whole);
  const Solution<2> found = turns.solve(model, whole);
  EXPECT_EQ(found.summary.outcome, Outcome::iteration_limit);
  EXPECT_LE(found.summary.iterations, 4);
  EXPECT_THAT(found.summary.reason, HasSubstr("limit of 4 cycles of all bodies"));
  EXPECT_EQ(found.x.size(), joint.finest().points.size() * 2);
}

std::string check(const std::string& text) {
  const Setting of(text);
  const Model<2> model = build_model<2>(of.scene, 2, of.registry, whole);
  return refused([&] { check_turns<2>(of.scene, 0, model); });
}

TEST(DirichletNeumann, RefusesWhatItDoesNotKnow) {
  const std::string turns = "bodies = \"dirichlet-neumann\"\n",
                    friction = "type = \"elastic_coulomb\"\nfriction = 0.2\n";
  EXPECT_EQ(check(pair(turns)), "");
  EXPECT_EQ(check(pair("", "type = \"elastic\"\n", 2)), "");
  EXPECT_THAT(check(pair(turns, friction)), HasSubstr("friction between bodies"));
  EXPECT_THAT(check(pair(turns, "type = \"elastic\"\n", 2)),
              AllOf(HasSubstr("order"), HasSubstr("quadratic elements")));
  const std::string self =
      tables::block("b", "[0, 0]", "[1, 1]", "[2, 2]") +
      "[[obstacle]]\ntype = \"elastic\"\nbody = \"b\"\non = \"left\"\nother = \"b\"\nother_on = \"right\"\n[solver]\n";
  EXPECT_THAT(check(self + turns), HasSubstr("touches itself"));
}

}  // namespace
}  // namespace signorini::test
