// Friction with quadratic elements: uniform stress exactly, the law at every node, and partial slip.
#include "apps/bench/friction/partial_slip.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

/// A block on a plane in two or three dimensions.
SceneText block(int dimension, double friction, int refinements, const char* poisson) {
  const bool plane = dimension == 2;
  return {.body = fmt::format("{}order = 2\nyoung = 1\npoisson = {}",
                              plane ? "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\n"
                                    : "shape = \"box\"\nfrom = [0, 0, 0]\nto = [2, 1, 1]\ncells = [4, 2, 2]\n",
                              poisson),
          .obstacle = fmt::format("type = \"coulomb\"\nfriction = {}\non = \"bottom\"\nshape = \"plane\"\npoint = {}\n"
                                  "normal = {}",
                                  friction, plane ? "[0, 0]" : "[0, 0, 0]", plane ? "[0, 1]" : "[0, 0, 1]"),
          .refinements = refinements};
}

/// Its law at every node, within a part of the largest force.
template <int D>
void expect_law(const ContactState<D>& contact, double friction) {
  double largest = 0;
  for (const ContactNode<D>& node : contact.nodes)
    for (const double f : node.force) largest = std::max(largest, std::abs(f));
  const double tolerance = 1e-7 * largest;
  for (const ContactNode<D>& node : contact.nodes) {
    double pressing = 0, along = 0;
    for (int i = 0; i < D; ++i) pressing += (node.force[i] - node.tangential[i]) * node.direction[i];
    for (const double f : node.tangential) along = std::hypot(along, f);
    EXPECT_GE(pressing, 0);
    EXPECT_LE(along, friction * pressing + tolerance) << node.vertex;
    if (!node.sticks) {
      EXPECT_NEAR(along, friction * pressing, tolerance) << node.vertex;
    }
    EXPECT_GE(node.dissipated, 0);
  }
}

// Pressure p and shear q by loads on all sides: quadratic elements have uniform stress exactly, too.
TEST(QuadraticFriction, ABlockSticksBelowTheLimitAndSlidesAbove) {
  const double p = 0.03, q = 0.4 * p, shear = 0.5;
  const auto pushed = [&](double friction) {
    SceneText scene = block(2, friction, 1, "0");
    scene.fixes = {"on = \"top\"\nvalue = [\"free\", -0.03]"};
    scene.loads = {fmt::format("on = \"top\"\nvalue = [{}, 0]", q), fmt::format("on = \"right\"\nvalue = [0, {}]", q),
                   fmt::format("on = \"left\"\nvalue = [0, {}]", -q)};
    return scene;
  };
  const auto r = run<2, 2>(pushed(0.41));
  const std::vector<double> u = r.nodes().at_vertices(r.u(), 2);
  for (Index v = 0; v < r.mesh().vertices(); ++v) {
    const double y = r.mesh().points[v][1];
    EXPECT_NEAR(u[2 * v], q * y / shear, 1e-9);
    EXPECT_NEAR(u[2 * v + 1], -p * y, 1e-9);
  }
  EXPECT_EQ(r.contact().slip_nodes, 0);
  EXPECT_EQ(r.contact().stick_nodes, r.contact().nodes);
  Driver driver(parse_scene(std::string(pushed(0.39)), "test.toml", "."));
  const Summary& summary = driver.solve().last().summary;
  EXPECT_EQ(summary.outcome, Outcome::stuck) << summary.reason;
}

TEST(QuadraticFriction, UniformSlipIsExact) {
  const double p = 0.03, friction = 0.2, g = friction * p, shear = 0.5;
  SceneText scene = block(2, friction, 1, "0");
  scene.fixes = {"on = \"top\"\nvalue = [0.02, -0.03]"};
  scene.loads = {fmt::format("on = \"right\"\nvalue = [0, {}]", g), fmt::format("on = \"left\"\nvalue = [0, {}]", -g)};
  const auto r = run<2, 2>(scene, {"solver.tolerance=1e-11"});
  const std::vector<double> u = r.nodes().at_vertices(r.u(), 2);
  for (Index v = 0; v < r.mesh().vertices(); ++v) {
    const double y = r.mesh().points[v][1];
    EXPECT_NEAR(u[2 * v], 0.02 - g * (1 - y) / shear, 1e-10);
    EXPECT_NEAR(u[2 * v + 1], -p * y, 1e-10);
  }
  EXPECT_EQ(r.contact().stick_nodes, 0);
  // Pressure and slip grow together: half of the final force times the way.
  EXPECT_NEAR(r.contact().dissipated, g * (0.02 - g / shear), 1e-11);
  expect_law(r.results.contact, friction);
}

TEST(QuadraticFriction, ItsLawHoldsAtEveryNode) {
  for (const double friction : {0.1, 0.3}) {
    SceneText plane = block(2, friction, 2, "0.3"), space = block(3, friction, 0, "0.3");
    plane.fixes = {"on = \"top\"\nvalue = [0.01, -0.03]"};
    space.fixes = {"on = \"top\"\nvalue = [0.01, 0.005, -0.03]"};
    expect_law((run<2, 2>(plane).results.contact), friction);
    expect_law((run<3, 3>(space).results.contact), friction);
  }
}

// To the force and the dissipation that linear elements find on a far finer mesh.
TEST(QuadraticFriction, TendsToWhatLinearElementsDo) {
  const auto solved = [](int order, int refinements) {
    SceneText scene = block(2, 0.3, refinements, "0.3");
    if (order == 1) scene.body.replace(scene.body.find("order = 2"), 9, "order = 1");
    scene.fixes = {"on = \"top\"\nvalue = [0.01, -0.03]"};
    return run<2, 2>(scene).contact();
  };
  const auto fine = solved(1, 7);
  Errors force, dissipated;
  for (const int refinements : {1, 2, 3, 4}) {
    const auto coarse = solved(2, refinements);
    force.add(std::abs(coarse.tangential_force[0] / fine.tangential_force[0] - 1));
    dissipated.add(std::abs(coarse.dissipated / fine.dissipated - 1));
    show("force off by {:.2e}, dissipated by {:.2e}\n", force.value.back(), dissipated.value.back());
  }
  force.expect_falling();
  dissipated.expect_falling();
  EXPECT_LE(force.value.back(), 0.001);
  EXPECT_LE(dissipated.value.back(), 0.05);
}

// Cattaneo's line contact, see apps/bench/friction/partial_slip.hpp.
TEST(QuadraticFriction, PartialSlipOfALineContact) {
  const bench::PartialSlip slip = bench::solve_partial_slip({2, 2, false, {"body.0.order=2"}});
  const bench::PartialSlipStep& step = slip.steps[1];
  show("contact {:.4f} and {:.4f}, stick {:.4f} and {:.4f}, traction off by {:.1f} %, {} and {} cycles\n", step.contact,
       step.contact_in_theory, step.stick, step.stick_in_theory, 100 * step.mean_error, slip.steps[0].iterations,
       step.iterations);
  EXPECT_NEAR(step.contact, step.contact_in_theory, 0.02 * step.contact);
  EXPECT_NEAR(step.stick, step.stick_in_theory, 0.05 * step.stick);
  EXPECT_LE(step.mean_error, 0.05);
}

}  // namespace
}  // namespace signorini::test
