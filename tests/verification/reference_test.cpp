// Scenes of every kind against an independent solver: the same coincidence set and the same solution.
#include "run.hpp"
#include "scene_text.hpp"
#include "tests/support/pdas.hpp"

namespace signorini::test {
namespace {

struct Expectation {
  bool degenerate = false;  ///< contact without force, so that the coincidence set is not determined by forces
  int least = 1;            ///< unknowns in contact
};

/// Where the force or the distance decide clearly, contact is contact in both.
template <int D, int B>
void expect_same_contact(const Run<D, B>& r, const Reference& exact) {
  const DiscreteProblem<B>& p = r.problem();
  for (Index slot = 0; slot < p.constraints.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Index v = p.constraints.vector[slot];
      if (p.fixed[v] >> k & 1) continue;
      const double x = r.solution.x[Offset{v} * B + k];
      const bool contact = x == p.constraints.lower[slot * B + k] || x == p.constraints.upper[slot * B + k];
      const signed char state = exact.state[Offset{v} * B + k];
      ASSERT_EQ(contact, state == 1 || state == -1) << "vertex " << v << ", direction " << k;
    }
}

template <int D, int B>
Run<D, B> expect_reference(const Scene& scene, Expectation expected = {}) {
  auto r = run<D, B>(scene);
  const Reference exact = reference(r.problem());
  EXPECT_GE(exact.active(), expected.least);
  if (!expected.degenerate) expect_same_contact(r, exact);
  const Eigen::VectorXd x = vector(r.solution.x);
  EXPECT_LE((x - exact.x).norm(), 1e-8 * exact.x.norm());
  EXPECT_LE((x - exact.x).cwiseAbs().maxCoeff(), 1e-8 * exact.x.cwiseAbs().maxCoeff());
  show("{}: {} unknowns, {} active, {} cycles, rate {:.2f}, difference {:.1e}\n",
       testing::UnitTest::GetInstance()->current_test_info()->name(), x.size(), exact.active(), r.summary().iterations,
       r.summary().rate, (x - exact.x).norm() / exact.x.norm());
  return r;
}

const std::vector<std::string> exactly{"solver.tolerance=1e-10"};

template <int D, int B>
Run<D, B> expect_reference(const std::string& scene, Expectation expected = {}) {
  return expect_reference<D, B>(parse_scene(scene, "test.toml", ".", exactly), expected);
}

template <int D, int B>
void expect_shipped_reference(const std::string& file, int refinements) {
  expect_reference<D, B>(shipped(file, {exactly.front(), uniform(refinements)}));
}

constexpr const char* square = R"(
shape = "rectangle"
from = [0, 0]
to = [1, 1]
cells = [3, 3]
equation = "diffusion")";

SceneText membrane(const std::string& source, const std::string& bounds, const std::string& boundary = "0") {
  return {.body = square,
          .fixes = {fmt::format("on = \"boundary\"\nvalue = [\"{}\"]", boundary)},
          .loads = {fmt::format("value = [\"{}\"]", source)},
          .obstacle = "type = \"scalar\"\n" + bounds,
          .refinements = 4};
}

TEST(Reference, TwoSidedBounds) {
  const auto r = expect_reference<2, 1>(membrane("20*sin(7*x)*cos(5*y)", "lower = -0.02\nupper = \"0.01 + 0.02*x\""));
  Index lower = 0, upper = 0;
  for (const auto& node : r.results.contact.nodes) {
    lower += node.contact && node.force[0] > 0;
    upper += node.contact && node.force[0] < 0;
  }
  EXPECT_GT(lower, 10);
  EXPECT_GT(upper, 10);
}

TEST(Reference, FullContact) {
  const auto r = expect_reference<2, 1>(membrane("-1", "lower = 0"));
  for (const double u : r.u()) ASSERT_EQ(u, 0);
}

TEST(Reference, NoContact) {
  const auto r = expect_reference<2, 1>(membrane("1 + x", "lower = -1\nupper = 1"), {.least = 0});
  EXPECT_EQ(r.contact().nodes, 0);
}

TEST(Reference, EqualBounds) {
  const auto r = expect_reference<2, 1>(
      membrane("3", "lower = \"x < 0.4 ? x*y*0.1 : -1\"\nupper = \"x < 0.4 ? x*y*0.1 : 1\"", "x < 0.4 ? x*y*0.1 : 0"));
  for (const auto& node : r.results.contact.nodes) ASSERT_TRUE(node.contact || r.mesh().points[node.vertex][0] >= 0.4);
}

TEST(Reference, ContactWithoutForce) {
  expect_reference<2, 1>(membrane("2*x*(1-x) + 2*y*(1-y)", "upper = \"x*(1-x)*y*(1-y)\""),
                         {.degenerate = true, .least = 0});
  // u = 1 touches the left half of the obstacle without any force.
  expect_reference<2, 1>(membrane("0", "lower = \"1 - max(0, x - 0.5)\"", "1"), {.degenerate = true, .least = 0});
}

TEST(Reference, Spiral) { expect_shipped_reference<2, 1>("obstacle_spiral.toml", 4); }

TEST(Reference, ScalarSignoriniOnAPart) {
  expect_reference<2, 1>(SceneText{.body = R"(
shape = "disk"
center = [0, 0]
radius = 1
size = 0.3
equation = "diffusion")",
                                   .fixes = {"where = \"y > 0.7\"\nvalue = [0]"},
                                   .loads = {"value = ['4*sin(5*x + 1)']"},
                                   .obstacle = R"(
type = "scalar"
where = "y < 0.2"
lower = -0.05
upper = 0.4)",
                                   .refinements = 3});
}

TEST(Reference, TorsionOfARoundBar) { expect_shipped_reference<2, 1>("obstacle_torsion_disk.toml", 3); }

/// An elastic block over a rigid obstacle.
SceneText block2(const std::string& obstacle) {
  return {.body = R"(
shape = "rectangle"
from = [0, 0]
to = [2, 1]
cells = [4, 2]
order = 1
young = 1.0
poisson = 0.3)",
          .fixes = {"on = \"top\"\nvalue = [0.01, -0.05]"},
          .obstacle = "type = \"contact\"\non = \"bottom\"\n" + obstacle,
          .refinements = 3};
}

TEST(Reference, ElasticBlockOnACircle) {
  expect_reference<2, 2>(block2("shape = \"sphere\"\ncenter = [0.8, -3]\nradius = 2.98"));
}

TEST(Reference, ElasticBlockOnAnIncline) {
  expect_reference<2, 2>(block2("shape = \"plane\"\npoint = [0, -0.04]\nnormal = [-0.1, 1]"));
}

TEST(Reference, ElasticBlockOnAHillByExpression) {
  expect_reference<2, 2>(block2("shape = \"expression\"\ndistance = \"y + 0.02 + 0.02*cos(6*x)\""));
}

TEST(Reference, BodyHeldByTheObstacleOnly) {
  // Nothing but the plane stops the block from moving down, and from turning.
  SceneText block = block2("shape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]");
  block.fixes = {"on = \"left\"\nframe = \"normal\"\nvalue = [0, \"free\"]"};
  block.loads = {"value = [0.01, -0.1]", "on = \"top\"\nvalue = [0, \"-0.2*(x > 0.5)\"]"};
  expect_reference<2, 2>(block);
  // A membrane with a flux, held by a bump of the obstacle.
  SceneText loose = membrane("-1 - x", "lower = \"0.2 - x^2 - y\"");
  loose.fixes.clear();
  loose.refinements = 3;
  expect_reference<2, 1>(loose);
}

SceneText half_ball(const std::string& obstacle) {
  return {.body = R"(
shape = "half_ball"
center = [0, 0, 0]
radius = 1
size = 0.5
order = 1
young = 1.0
poisson = 0.3)",
          .fixes = {"on = \"flat\"\nvalue = [0.01, 0, -0.05]"},
          .obstacle = "type = \"contact\"\non = \"curved\"\n" + obstacle,
          .refinements = 1};
}

TEST(Reference, BallOnAPlane) {
  expect_reference<3, 3>(half_ball("shape = \"plane\"\npoint = [0, 0, -1]\nnormal = [0, 0, 1]"));
}

TEST(Reference, BallInABedWithNormalsOfTheBody) {
  expect_reference<3, 3>(
      half_ball("shape = \"sphere\"\ncenter = [0, 0, 0.05]\nradius = 1.05\ninside = true\nnormal = \"body\""));
}

TEST(Reference, BallOnACylinder) {
  expect_reference<3, 3>(half_ball("shape = \"cylinder\"\ncenter = [0, 0, -2]\naxis = [1, 0.2, 0]\nradius = 1"));
}

TEST(Reference, BlockOnASurfaceMesh) { expect_shipped_reference<3, 3>("block_on_surface.toml", 1); }

}  // namespace
}  // namespace signorini::test
