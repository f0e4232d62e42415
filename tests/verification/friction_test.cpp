// Friction with a given bound: closed forms, an independent convex solver, what has to hold at every vertex, and the
// iterations it costs beside frictionless contact.
#include "tests/support/friction.hpp"
#include "core/base/error.hpp"
#include "core/mesh/structured.hpp"
#include "driver/driver.hpp"
#include "mesh_file.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

constexpr const char* on_plane = "on = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]";
constexpr const char* on_floor = "on = \"bottom\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]";

std::string with_friction(const char* where, const std::string& bound) {
  return std::string(where) + "\ntype = \"tresca\"\nbound = " + bound;
}
std::string frictionless(const char* where) { return std::string(where) + "\ntype = \"contact\""; }

SceneText block2(const std::string& obstacle, int refinements) {
  return {
      .body = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\norder = 1\nyoung = 1\npoisson = 0.3",
      .fixes = {"on = \"top\"\nvalue = [0.02, -0.03]"},
      .obstacle = obstacle,
      .refinements = refinements};
}

SceneText block3(const std::string& obstacle, int refinements) {
  return {
      .body =
          "shape = \"box\"\nfrom = [0, 0, 0]\nto = [2, 1, 1]\ncells = [2, 1, 1]\norder = 1\nyoung = 1\npoisson = 0.3",
      .fixes = {"on = \"top\"\nvalue = [0.02, 0.01, -0.03]"},
      .obstacle = obstacle,
      .refinements = refinements};
}

// Uniform shear g and pressure p, sliding everywhere: u_x = s + g y / G, which linear elements have exactly.
TEST(Tresca, UniformSlipIsExact) {
  const double g = 0.004, young = 1, shear = young / 2;
  const SceneText scene{
      .body = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\norder = 1\nyoung = 1\npoisson = 0",
      .fixes = {"on = \"top\"\nvalue = [0.02, -0.03]"},
      .loads = {fmt::format("on = \"right\"\nvalue = [0, {}]", g), fmt::format("on = \"left\"\nvalue = [0, {}]", -g)},
      .obstacle = with_friction(on_plane, fmt::format("{}", g)),
      .refinements = 2};
  const auto r = run<2, 2>(scene);
  for (Index p = 0; p < r.mesh().vertices(); ++p) {
    const double y = r.mesh().points[p][1];
    EXPECT_NEAR(r.u()[2 * p], 0.02 - g * (1 - y) / shear, 1e-10);
    EXPECT_NEAR(r.u()[2 * p + 1], -0.03 * y, 1e-10);
  }
  EXPECT_NEAR(r.contact().tangential_force[0], -2 * g, 1e-10);
  EXPECT_NEAR(r.contact().dissipated, 2 * g * (0.02 - g / shear), 1e-11);
  EXPECT_EQ(r.contact().slip_nodes, 17);
  EXPECT_EQ(r.contact().stick_nodes, 0);
}

template <int D>
void expect_like_convex_solver(const std::string& scene) {
  const auto r = run<D, D>(scene, {"solver.tolerance=1e-11"});
  const auto& problem = r.problem();
  const Eigen::VectorXd expected =
      convex_minimiser(dense(problem.A), vector(problem.b), friction_prox<D>(problem), 1e-13);
  EXPECT_LE((vector(r.solution.x) - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
  for (const ContactNode<D>& node : r.results.contact.nodes) {
    double traction = 0;
    for (const double f : node.tangential) traction = std::hypot(traction, f);
    const Index slot = problem.constraints.slot[node.vertex];
    const double bound = problem.constraints.data[static_cast<std::size_t>(slot)];
    EXPECT_LE(traction, bound * (1 + 1e-6) + 1e-12);
    if (!node.sticks) {
      EXPECT_NEAR(traction, bound, 1e-6 * bound + 1e-12);
    }
    EXPECT_GE(node.dissipated, -1e-14);
  }
}

TEST(Tresca, ScenesAreSolvedLikeByAConvexSolver) {
  expect_like_convex_solver<2>(block2(with_friction(on_plane, "0.008"), 2));
  expect_like_convex_solver<2>(block2(with_friction(on_plane, "\"0.02 * x\""), 2));
  expect_like_convex_solver<3>(block3(with_friction(on_floor, "0.008"), 1));
  SceneText guided = block3(with_friction(on_floor, "\"0.01 * y\""), 1);
  guided.fixes.push_back("on = \"left\"\nvalue = [0.01, \"free\", \"free\"]");
  expect_like_convex_solver<3>(guided);
  SceneText bilateral = block2(with_friction(on_plane, "0.006"), 2);
  bilateral.fixes.push_back("on = \"bottom\"\nvalue = [\"free\", 0]");
  expect_like_convex_solver<2>(bilateral);
  SceneText round = block2(
      "on = \"bottom\"\nshape = \"sphere\"\ncenter = [0.8, -3]\nradius = 3\ntype = \"tresca\"\n"
      "bound = 0.004",
      2);
  expect_like_convex_solver<2>(round);
}

TEST(Tresca, NoFrictionIsContactAndMuchOfItGlue) {
  const auto slides = run<2, 2>(block2(with_friction(on_plane, "0"), 3));
  const auto contact = run<2, 2>(block2(frictionless(on_plane), 3));
  for (std::size_t i = 0; i < contact.u().size(); ++i) ASSERT_NEAR(slides.u()[i], contact.u()[i], 1e-9);
  const auto glued = run<2, 2>(block2(with_friction(on_plane, "1e6"), 3));
  for (Index p = 0; p < glued.mesh().vertices(); ++p)
    if (glued.mesh().points[p][1] == 0) {
      EXPECT_EQ(glued.u()[2 * p], 0);
    }
  EXPECT_EQ(glued.contact().slip_nodes, 0);
}

TEST(Tresca, ScenesMayBeTurnedAndScaled) {
  const TemporaryFolder folder;
  const Mesh<2> mesh = rectangle({0, 0}, {2, 1}, {4, 2});
  const auto scene = [&](Motion<2> motion, double scale, double stress) {
    motion.scale = scale;
    const std::string file = folder.write(fmt::format("{}.msh", scale), msh(mesh, motion));
    const Point<2> lowered = motion.turned({0.02 * scale, -0.03 * scale});
    return SceneText{.body = fmt::format("mesh = \"{}\"\norder = 1\nyoung = {}\npoisson = 0.3", file, stress),
                     .fixes = {"on = \"top\"\nvalue = " + text(lowered)},
                     .obstacle = fmt::format("type = \"tresca\"\nbound = {}\non = \"bottom\"\nshape = \"plane\"\n"
                                             "point = [0, 0]\nnormal = {}",
                                             0.008 * stress, text(motion.turned({0, 1}))),
                     .refinements = 2};
  };
  const auto first = run<2, 2>(scene({}, 1, 1)), other = run<2, 2>(scene(rotation2(0.7), 1e3, 2e5));
  const double size = 1e3 * 2e5;
  const Point<2> force = rotation2(0.7).turned(first.contact().force);
  EXPECT_NEAR(other.contact().force[0] / size, force[0], 1e-8);
  EXPECT_NEAR(other.contact().force[1] / size, force[1], 1e-8);
  EXPECT_NEAR(other.contact().dissipated / size / 1e3, first.contact().dissipated, 1e-9);
  EXPECT_EQ(other.contact().slip_nodes, first.contact().slip_nodes);
  EXPECT_EQ(other.summary().iterations, first.summary().iterations);
}

// Friction where a second obstacle holds the same vertices along another direction.
TEST(Tresca, InACornerItIsSolvedToRounding) {
  SceneText plane = block2(with_friction(on_plane, "0.004"), 3);
  plane.fixes = {"on = \"top\"\nvalue = [-0.01, -0.03]"};
  plane.obstacle +=
      "\n[[obstacle]]\nbody = \"b\"\ntype = \"contact\"\non = \"left\"\nshape = \"plane\"\npoint = [0, 0]\n"
      "normal = [1, 0.3]";
  SceneText space = block3(with_friction(on_floor, "0.004"), 2);
  space.fixes = {"on = \"top\"\nvalue = [-0.01, 0.005, -0.03]"};
  space.obstacle +=
      "\n[[obstacle]]\nbody = \"b\"\ntype = \"contact\"\non = \"left\"\nshape = \"plane\"\npoint = [0, 0, 0]\n"
      "normal = [1, 0.1, 0.3]";
  const auto in_plane = run<2, 2>(plane, {"solver.tolerance=1e-12"});
  const auto in_space = run<3, 3>(space, {"solver.tolerance=1e-12"});
  EXPECT_FALSE(in_plane.problem().constraints.facet.empty()) << "no test";
  EXPECT_FALSE(in_space.problem().constraints.facet.empty()) << "no test";
  EXPECT_LE(in_plane.summary().iterations, 30);
  EXPECT_LE(in_space.summary().iterations, 30);
}

// Pushed there and back in steps, the block keeps some of the way, and friction works both ways.
TEST(Tresca, OpposesTheMotionSinceTheLastStep) {
  SceneText scene = block2(with_friction(on_plane, "0.004"), 2);
  scene.fixes = {"on = \"top\"\nvalue = [\"t <= 0.5 ? 0.04 * t : 0.04 * (1 - t)\", -0.03]"};
  Scene parsed = parse_scene(std::string(scene) + "[steps]\ncount = 4\n", "test.toml", ".");
  Driver driver(std::move(parsed));
  const Report& report = driver.solve();
  ASSERT_EQ(report.steps.size(), 4u);
  double last = 0;
  for (const StepReport& step : report.steps) {
    ASSERT_TRUE(step.summary.converged()) << step.summary.reason;
    EXPECT_GE(step.contact[0].dissipated, last);
    last = step.contact[0].dissipated;
  }
  EXPECT_LT(report.steps[1].contact[0].tangential_force[0], 0);
  EXPECT_GT(report.steps[3].contact[0].tangential_force[0], 0) << "pulled back";
  EXPECT_GT(last, report.steps[1].contact[0].dissipated);
}

// Friction bears 0.008 times the width 2, a body force f over the area 2.
TEST(Tresca, BodiesHeldByFrictionAloneAreSolvedUpToWhatItBears) {
  const auto pushed = [](double force) {
    SceneText scene = block2(with_friction(on_plane, "0.008"), 2);
    scene.fixes.clear();
    scene.loads = {fmt::format("value = [{}, -0.01]", force)};
    return scene;
  };
  for (const double force : {0.003, 0.0078, -0.0078})
    EXPECT_NEAR((run<2, 2>(pushed(force)).contact().tangential_force[0]), -2 * force, 1e-8);
  try {
    run<2, 2>(pushed(0.0082));
    FAIL() << "held";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::no_solution) << error.what();
  }
}

TEST(Tresca, FrictionCostsFewIterationsOnAllMeshes) {
  for (const int refinements : {3, 4, 5}) {
    const auto plain = run<2, 2>(block2(frictionless(on_plane), refinements));
    const auto rough = run<2, 2>(block2(with_friction(on_plane, "0.008"), refinements));
    show("2D, {} refinements: {} and {} iterations\n", refinements, plain.summary().iterations,
         rough.summary().iterations);
    EXPECT_LE(rough.summary().iterations, plain.summary().iterations + 3);
  }
  const auto plain = run<3, 3>(block3(frictionless(on_floor), 3));
  const auto rough = run<3, 3>(block3(with_friction(on_floor, "0.008"), 3));
  show("3D: {} and {} iterations\n", plain.summary().iterations, rough.summary().iterations);
  EXPECT_LE(rough.summary().iterations, plain.summary().iterations + 3);
}

// As long as all of the block slips nothing but kinks holds it along the plane.
TEST(Tresca, VeryLittleFrictionHoldsABlockAsFast) {
  for (const int refinements : {0, 1, 3})
    for (const char* bound : {"1e-3", "1e-5", "1e-6"}) {
      SceneText scene = block2(with_friction(on_plane, bound), refinements);
      scene.body =
          "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [10, 2]\norder = 1\nyoung = 1\npoisson = 0.3";
      scene.fixes = {"on = \"top\"\nvalue = [\"free\", -0.04]"};
      EXPECT_LE((run<2, 2>(scene).summary().iterations), 25) << refinements << " refinements, bound " << bound;
      const auto exact = run<2, 2>(scene, {"solver.tolerance=1e-10"});
      EXPECT_NEAR(exact.contact().tangential_force[0], 0, 1e-9 * exact.contact().force[1]);
    }
}

}  // namespace
}  // namespace signorini::test
