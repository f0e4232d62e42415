// Friction by Coulomb's law: closed forms, what has to hold at every vertex, steps, invariances, what is refused.
#include <gmock/gmock.h>

#include <functional>

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

std::string coulomb(const std::string& where, const std::string& friction) {
  return where + "\ntype = \"coulomb\"\nfriction = " + friction;
}

SceneText block2(const std::string& obstacle, int refinements, const char* poisson = "0.3") {
  return {
      .body =
          std::string(
              "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\norder = 1\nyoung = 1\npoisson = ") +
          poisson,
      .fixes = {"on = \"top\"\nvalue = [0.01, -0.03]"},
      .obstacle = obstacle,
      .refinements = refinements};
}

SceneText block3(const std::string& obstacle, int refinements) {
  return {
      .body =
          "shape = \"box\"\nfrom = [0, 0, 0]\nto = [2, 1, 1]\ncells = [2, 1, 1]\norder = 1\nyoung = 1\npoisson = 0.3",
      .fixes = {"on = \"top\"\nvalue = [0.01, 0.005, -0.03]"},
      .obstacle = obstacle,
      .refinements = refinements};
}

/// Coulomb's law at every vertex, from the results alone.
template <int D>
void expect_law(const ContactState<D>& contact, double friction, double tolerance) {
  double largest = 0;
  for (const ContactNode<D>& node : contact.nodes)
    for (const double f : node.force) largest = std::max(largest, std::abs(f));
  for (const ContactNode<D>& node : contact.nodes) {
    double pressing = 0, across = 0;
    for (int i = 0; i < D; ++i) pressing += (node.force[i] - node.tangential[i]) * node.direction[i];
    for (const double f : node.tangential) across = std::hypot(across, f);
    EXPECT_GE(pressing, 0);
    EXPECT_LE(across, friction * pressing + tolerance * largest) << node.vertex;
    if (!node.sticks) {
      EXPECT_NEAR(across, friction * pressing, tolerance * largest) << node.vertex;
    }
    EXPECT_GE(node.dissipated, 0);
    double traction = 0;  // recovered, as the pressure is
    for (const double t : node.traction) traction = std::hypot(traction, t);
    if (node.contact) {
      EXPECT_LE(traction, friction * node.recovered * (1 + 1e-12)) << node.vertex;
    }
  }
}

// Uniform pressure p = 0.03 and shear q by loads on all sides: it sticks below mu p and slides above, in the whole.
TEST(Coulomb, ABlockUnderPressureSticksBelowTheLimitAndSlidesAbove) {
  const double p = 0.03, shear = 0.5;
  const auto pushed = [&](double q, double friction) {
    SceneText scene = block2(coulomb(on_plane, fmt::format("{}", friction)), 2, "0");
    scene.fixes = {"on = \"top\"\nvalue = [\"free\", -0.03]"};
    scene.loads = {fmt::format("on = \"top\"\nvalue = [{}, 0]", q), fmt::format("on = \"right\"\nvalue = [0, {}]", q),
                   fmt::format("on = \"left\"\nvalue = [0, {}]", -q)};
    return scene;
  };
  const double q = 0.4 * p;
  const auto r = run<2, 2>(pushed(q, 0.41));
  for (Index v = 0; v < r.mesh().vertices(); ++v) {
    const double y = r.mesh().points[v][1];
    EXPECT_NEAR(r.u()[2 * v], q * y / shear, 1e-9);
    EXPECT_NEAR(r.u()[2 * v + 1], -p * y, 1e-9);
    if (y == 0) {
      EXPECT_EQ(r.u()[2 * v], 0);
    }
  }
  EXPECT_EQ(r.contact().slip_nodes, 0);
  Driver driver(parse_scene(std::string(pushed(q, 0.39)), "test.toml", "."));
  const Summary& summary = driver.solve().last().summary;
  EXPECT_FALSE(summary.converged());
  EXPECT_EQ(summary.outcome, Outcome::stuck) << summary.reason;
}

// The same with the top moved: the shear is mu p wherever the top goes.
TEST(Coulomb, UniformSlipIsExact) {
  const double p = 0.03, friction = 0.2, g = friction * p, shear = 0.5;
  SceneText scene = block2(coulomb(on_plane, "0.2"), 2, "0");
  scene.fixes = {"on = \"top\"\nvalue = [0.02, -0.03]"};
  scene.loads = {fmt::format("on = \"right\"\nvalue = [0, {}]", g), fmt::format("on = \"left\"\nvalue = [0, {}]", -g)};
  const auto r = run<2, 2>(scene, {"solver.tolerance=1e-11"});
  for (Index v = 0; v < r.mesh().vertices(); ++v) {
    const double y = r.mesh().points[v][1];
    EXPECT_NEAR(r.u()[2 * v], 0.02 - g * (1 - y) / shear, 1e-10);
    EXPECT_NEAR(r.u()[2 * v + 1], -p * y, 1e-10);
  }
  EXPECT_EQ(r.contact().stick_nodes, 0);
  // Pressure and slip grow together: half of the final force times the way.
  EXPECT_NEAR(r.contact().dissipated, g * (0.02 - g / shear), 1e-11);
  expect_law(r.results.contact, friction, 1e-7);
}

TEST(Coulomb, ItsLawHoldsAtEveryVertex) {
  for (const char* friction : {"0.1", "0.3", "0.6", "1"}) {
    const auto plane = run<2, 2>(block2(coulomb(on_plane, friction), 3));
    expect_law(plane.results.contact, std::atof(friction), 1e-7);
    const auto space = run<3, 3>(block3(coulomb(on_floor, friction), 2));
    expect_law(space.results.contact, std::atof(friction), 1e-7);
  }
}

// No plugin of friction takes part: not even the last bit differs.
TEST(Coulomb, WithoutFrictionItIsContactToTheBit) {
  const auto slides = run<3, 3>(block3(coulomb(on_floor, "0"), 2));
  const auto contact = run<3, 3>(block3(std::string(on_floor) + "\ntype = \"contact\"", 2));
  EXPECT_EQ(slides.u(), contact.u());
  EXPECT_EQ(slides.summary().iterations, contact.summary().iterations);
  EXPECT_FALSE(has_functional(slides.problem().segments));
  // An expression that is zero is friction without any force.
  const auto zero = run<2, 2>(block2(coulomb(on_plane, "\"0 * x\""), 3));
  const auto flat = run<2, 2>(block2(std::string(on_plane) + "\ntype = \"contact\"", 3));
  for (std::size_t i = 0; i < zero.u().size(); ++i) ASSERT_NEAR(zero.u()[i], flat.u()[i], 1e-9);
}

TEST(Coulomb, TheStartAndTheMethodDoNotMatter) {
  const std::string scene = block2(coulomb(on_plane, "0.3"), 3);
  const auto first = run<2, 2>(scene, {"solver.tolerance=1e-11"});
  for (const char* other : {"solver.start=zero", "solver.method=monotone", "solver.method=tnnmg", "solver.krylov=false",
                            "solver.threads=2", "solver.pre=1"}) {
    const auto second = run<2, 2>(scene, {"solver.tolerance=1e-11", other});
    for (std::size_t i = 0; i < first.u().size(); ++i) ASSERT_NEAR(first.u()[i], second.u()[i], 1e-10) << other;
    EXPECT_EQ(first.contact().slip_nodes, second.contact().slip_nodes) << other;
  }
}

// What sticks and what slips has to be found on the way: that may cost a few cycles, from levels by the matrix, too.
TEST(Coulomb, LevelsByTheMatrixTakeHardlyMoreCyclesThanWithoutFriction) {
  const std::vector<std::string> matrix{"solver.hierarchy=matrix"};
  for (const int refinements : {4, 5}) {
    const auto with = run<2, 2>(block2(coulomb(on_plane, "0.3"), refinements), matrix);
    const auto without = run<2, 2>(block2(coulomb(on_plane, "0"), refinements), matrix);
    EXPECT_GT(with.contact().slip_nodes, 0);
    EXPECT_GT(with.contact().stick_nodes, 0);
    EXPECT_LE(with.summary().iterations, 1.4 * without.summary().iterations) << refinements;
  }
}

// Where all slips in the end what sticks meanwhile gives way layer by layer: acceleration does not wait for that.
TEST(Coulomb, CyclesAreAcceleratedWhilePhasesComeToRest) {
  const std::vector<std::string> pushed{"solver.hierarchy=matrix", "fix.0.value=[0.1, -0.01]"};
  const auto with = run<2, 2>(block2(coulomb(on_plane, "0.3"), 6), pushed);
  const auto without = run<2, 2>(block2(coulomb(on_plane, "0"), 6), pushed);
  EXPECT_LE(with.summary().iterations, 1.5 * without.summary().iterations);
}

const Report& solve(Driver& driver) {
  const Report& report = driver.solve();
  for (const StepReport& step : report.steps) EXPECT_TRUE(step.summary.converged()) << step.summary.reason;
  return report;
}

// A block that is held at its top on a plane that slides: the same as the top moved over a plane at rest, but for the
// motion of the whole; tresca friction likewise.
TEST(Coulomb, ASlidingPlaneDragsTheBlockWithIt) {
  for (const char* law : {"type = \"coulomb\"\nfriction = 0.3", "type = \"tresca\"\nbound = 0.006"}) {
    SceneText resting = block2(std::string(on_plane) + "\n" + law, 3), sliding = resting;
    resting.fixes = {"on = \"top\"\nvalue = [\"0.04*t*(1 - t)\", -0.03]"};
    sliding.fixes = {"on = \"top\"\nvalue = [0, -0.03]"};
    sliding.obstacle =
        std::string("on = \"bottom\"\nshape = \"plane\"\npoint = [\"-0.04*t*(1 - t)\", 0]\nnormal = [0, 1]\n") + law;
    Driver first(parse_scene(std::string(resting) + "[steps]\ncount = 4\n", "test.toml", ".")),
        second(parse_scene(std::string(sliding) + "[steps]\ncount = 4\n", "test.toml", "."));
    const Report &a = solve(first), &b = solve(second);
    double last = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double t = 0.25 * static_cast<double>(k + 1);
      EXPECT_NEAR(a.steps[k].contact[0].tangential_force[0], b.steps[k].contact[0].tangential_force[0], 1e-9) << t;
      EXPECT_NEAR(a.steps[k].contact[0].dissipated, b.steps[k].contact[0].dissipated, 1e-10);
      EXPECT_EQ(a.steps[k].contact[0].slip_nodes, b.steps[k].contact[0].slip_nodes);
      EXPECT_GE(a.steps[k].contact[0].dissipated, last);
      last = a.steps[k].contact[0].dissipated;
    }
    EXPECT_GT(last, 0);
    for (std::size_t i = 0; i < first.solution().size(); i += 2)
      EXPECT_NEAR(first.solution()[i], second.solution()[i], 1e-8);
  }
}

// Nothing but a sliding plane moves a block that loads press on it: it follows exactly while it sticks.
TEST(Coulomb, ABlockThatSticksFollowsASlidingPlane) {
  SceneText scene = block3(
      "type = \"coulomb\"\nfriction = 0.5\non = \"bottom\"\nshape = \"plane\"\n"
      "point = [\"0.3*t\", \"-0.1*t\", 0]\nnormal = [0, 0, 1]",
      1);
  scene.fixes.clear();
  scene.loads = {"on = \"top\"\nvalue = [0, 0, -0.01]"};
  Driver driver(parse_scene(std::string(scene) + "[steps]\ncount = 2\n", "test.toml", "."));
  solve(driver);
  const std::vector<double>&u = driver.solution(), points = driver.points();
  SceneText still = scene;
  still.obstacle = coulomb(on_floor, "0.5");
  const auto pressed = run<3, 3>(still);
  for (std::size_t i = 0; i < u.size(); i += 3) {
    EXPECT_NEAR(u[i], 0.3 + pressed.u()[i], 1e-8);
    EXPECT_NEAR(u[i + 1], -0.1 + pressed.u()[i + 1], 1e-8);
    EXPECT_NEAR(u[i + 2], pressed.u()[i + 2], 1e-8);
  }
}

TEST(Coulomb, ScenesMayBeTurnedAndScaled) {
  const TemporaryFolder folder;
  const Mesh<2> mesh = rectangle({0, 0}, {2, 1}, {4, 2});
  const auto scene = [&](Motion<2> motion, double scale, double stress) {
    motion.scale = scale;
    const std::string file = folder.write(fmt::format("{}.msh", scale), msh(mesh, motion));
    const Point<2> lowered = motion.turned({0.01 * scale, -0.03 * scale});
    return SceneText{
        .body = fmt::format("mesh = \"{}\"\norder = 1\nyoung = {}\npoisson = 0.3", file, stress),
        .fixes = {"on = \"top\"\nvalue = " + text(lowered)},
        .obstacle = coulomb(
            "on = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = " + text(motion.turned({0, 1})), "0.3"),
        .refinements = 2};
  };
  const auto first = run<2, 2>(scene({}, 1, 1)), other = run<2, 2>(scene(rotation2(0.7), 1e3, 2e5));
  const double size = 1e3 * 2e5;
  const Point<2> force = rotation2(0.7).turned(first.contact().force);
  EXPECT_NEAR(other.contact().force[0] / size, force[0], 1e-8);
  EXPECT_NEAR(other.contact().force[1] / size, force[1], 1e-8);
  EXPECT_NEAR(other.contact().dissipated / size / 1e3, first.contact().dissipated, 1e-9);
  EXPECT_EQ(other.contact().slip_nodes, first.contact().slip_nodes);
}

// Two floors in one place, which rounding tells apart: that with friction presses.
TEST(Coulomb, OfTwoFloorsInOnePlaceTheRoughOnePresses) {
  const TemporaryFolder folder;
  const Motion<2> motion = rotation2(0.7);
  const std::string file = folder.write("turned.msh", msh(rectangle({0, 0}, {2, 1}, {4, 2}), motion));
  const auto floor = [&](double x) {
    return "on = \"bottom\"\nshape = \"plane\"\npoint = " + text(motion.turned({x, 0})) +
           "\nnormal = " + text(motion.turned({0, 1})) + "\n";
  };
  const auto contacts = [&](const std::string& more) {
    const SceneText scene{.body = fmt::format("mesh = \"{}\"\norder = 1\nyoung = 1\npoisson = 0.3", file),
                          .fixes = {"on = \"top\"\nvalue = " + text(motion.turned({0.01, -0.03}))},
                          .obstacle = coulomb(floor(0.1), "0.3"),
                          .refinements = 2};
    Driver driver(parse_scene(std::string(scene) + more, "test.toml", "."));
    return driver.solve().last().contact;
  };
  const auto alone = contacts(""), both = contacts("[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\n" + floor(1.7));
  EXPECT_EQ(both[1].nodes, 0);
  EXPECT_EQ(both[0].slip_nodes, alone[0].slip_nodes);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(both[0].force[i], alone[0].force[i], 1e-10);
}

TEST(Coulomb, TheOrderOfVerticesDoesNotMatter) {
  const TemporaryFolder folder;
  const Mesh<2> mesh = rectangle({0, 0}, {2, 1}, {8, 4});
  std::vector<Index> number(mesh.points.size());
  for (std::size_t p = 0; p < number.size(); ++p) number[p] = static_cast<Index>((p * 7) % number.size());
  const auto scene = [&](const std::string& file) {
    SceneText text = block2(coulomb(on_plane, "0.3"), 1);
    text.body = fmt::format("mesh = \"{}\"\norder = 1\nyoung = 1\npoisson = 0.3", file);
    return text;
  };
  const auto first = run<2, 2>(scene(folder.write("a.msh", msh(mesh))), {"solver.tolerance=1e-10"});
  const auto other =
      run<2, 2>(scene(folder.write("b.msh", msh(mesh, Motion<2>(), number))), {"solver.tolerance=1e-10"});
  EXPECT_NEAR(first.contact().tangential_force[0], other.contact().tangential_force[0], 1e-9);
  EXPECT_NEAR(first.contact().dissipated, other.contact().dissipated, 1e-10);
  EXPECT_EQ(first.contact().slip_nodes, other.contact().slip_nodes);
}

void expect_refused(const std::string& scene, const std::string& what) {
  try {
    Driver driver(parse_scene(scene, "test.toml", "."));
    driver.solve();
    FAIL() << "solved";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input) << error.what();
    EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
  }
}

void expect_slides(const std::function<void()>& solve) {
  try {
    solve();
    FAIL() << "solved";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::no_solution) << error.what();
    EXPECT_THAT(error.what(), testing::HasSubstr("friction does not hold the body"));
    EXPECT_THAT(error.what(), testing::HasSubstr("translation along (1, 0)"));
  }
}

// Nothing but friction holds the block: it does from the tangent of the angle on.
TEST(Coulomb, ABlockStaysOnAnInclineUpToTheAngleOfFriction) {
  const double angle = 0.35, weight = 0.01;
  const auto solve = [&](double friction) {
    SceneText scene = block2(coulomb(on_plane, fmt::format("{}", friction)), 2);
    scene.fixes.clear();
    scene.loads = {fmt::format("value = [{}, {}]", weight * std::sin(angle), -weight * std::cos(angle))};
    Driver driver(parse_scene(std::string(scene), "test.toml", "."));
    const StepReport& step = driver.solve().last();
    EXPECT_TRUE(step.summary.converged()) << step.summary.reason;
    EXPECT_NEAR(step.contact[0].tangential_force[0], -2 * weight * std::sin(angle), 1e-8);
  };
  for (const double off : {0.01, 0.003, 0.001}) {
    SCOPED_TRACE(off);
    solve((1 + off) * std::tan(angle));
    expect_slides([&] { solve((1 - off) * std::tan(angle)); });
  }
}

// Pressed and sheared a little beyond what friction bears.
TEST(Coulomb, ABlockThatFrictionHardlyFailsToHoldIsNotSolved) {
  const double pressure = 0.01, friction = 0.3;
  for (const double excess : {1e-5, 1e-4, 3e-4}) {
    SCOPED_TRACE(excess);
    SceneText scene = block2(coulomb(on_plane, fmt::format("{}", friction)), 1);
    scene.fixes.clear();
    scene.loads = {fmt::format("on = \"top\"\nvalue = [{:.17g}, {}]", (1 + excess) * friction * pressure, -pressure)};
    expect_slides([&] { Driver(parse_scene(std::string(scene), "test.toml", ".")).solve(); });
  }
}

TEST(Coulomb, ABlockThatIsUnloadedComesBackToZero) {
  for (const std::string left : {"0", "-2e-10", "1e-10", "1e-12", "-1e-13"}) {
    SCOPED_TRACE(left);
    SceneText scene = block2(coulomb(on_plane, "0.2"), 2, "0.32");
    scene.fixes = {"on = \"top\"\nvalue = [\"t < 0.6 ? 0.04*t : 0\", \"t < 0.6 ? -0.02 : " + left + "\"]"};
    Driver driver(parse_scene(std::string(scene) + "[steps]\ncount = 2\n", "test.toml", "."));
    const Report& report = driver.solve();
    EXPECT_TRUE(report.converged()) << report.reason();
    EXPECT_EQ(report.steps.size(), 2u);
    for (const double u : driver.solution()) EXPECT_LE(std::abs(u), 1e-9);
  }
}

// Between walls that open upwards by less than the angle of friction a block that is squeezed does not slip out.
TEST(Coulomb, ASqueezedBlockStaysBetweenWallsThatOpen) {
  for (const double tilt : {0.0, -0.01, 0.01}) {
    SCOPED_TRACE(tilt);
    std::string scene =
        "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [8, 8]\n"
        "order = 1\nyoung = 1\npoisson = 0.3\n[[load]]\nbody = \"b\"\nvalue = [0, \"t < 0.6 ? 0 : 0.002\"]\n"
        "[steps]\ncount = 2\n";
    for (const bool right : {false, true})
      scene += fmt::format(
          "[[obstacle]]\ntype = \"coulomb\"\nfriction = 0.5\nbody = \"b\"\non = \"{}\"\nshape = \"plane\"\n"
          "point = [\"{}\", 0.5]\nnormal = [{}, {}]\n",
          right ? "right" : "left", right ? "1 - 0.02 * min(1, 2*t)" : "0.02 * min(1, 2*t)", right ? -1 : 1, tilt);
    Driver driver(parse_scene(scene, "test.toml", "."));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    const auto& contact = report.last().contact;
    EXPECT_GE(contact[0].stick_nodes, 5);
    EXPECT_NEAR(contact[0].force[1] + contact[1].force[1], -0.002, 1e-9);
  }
}

// What has no friction neither slips nor sticks: where the coefficient is zero, and where nothing presses.
TEST(Coulomb, OnlyNodesWithFrictionSlipOrStick) {
  SceneText scene = block2(coulomb(on_plane, "\"x < 1 ? 0 : 0.3\""), 2);
  scene.fixes = {"on = \"top\"\nvalue = [0.01, \"-0.02 - 0.03*(x - 1)\"]"};
  const auto r = run<2, 2>(scene);
  Index rough = 0, smooth = 0, open = 0;
  for (const ContactNode<2>& node : r.results.contact.nodes) {
    open += !node.contact;
    smooth += node.contact && !node.friction;
    rough += node.friction;
    EXPECT_EQ(node.friction, node.contact && r.mesh().points[node.vertex][0] >= 1) << node.vertex;
    if (!node.friction) {
      EXPECT_FALSE(node.sticks) << node.vertex;
    }
  }
  EXPECT_GT(rough, 0);
  EXPECT_GT(smooth, 0);
  EXPECT_GT(open, 0) << "no test";
  EXPECT_EQ(r.contact().slip_nodes + r.contact().stick_nodes, rough);
}

// A rough floor below a smooth plate, and below half of one: what cannot press does not drag.
TEST(Coulomb, AnObstacleBehindAnotherOneDragsNothing) {
  for (const char* depth : {"0.5", "1e-6"}) {
    SCOPED_TRACE(depth);
    const auto contacts = [&](const char* plate) {
      const std::string floor =
          std::string("on = \"bottom\"\nshape = \"plane\"\npoint = [\"0.1*t\", -") + depth + "]\nnormal = [0, 1]";
      Driver driver(
          parse_scene(std::string(block2(coulomb(floor, "0.5"), 2)) +
                          "[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\non = \"bottom\"\nshape = \"expression\"\n" +
                          "distance = \"" + plate + "\"\n[steps]\ncount = 2\n",
                      "test.toml", "."));
      const Report& report = driver.solve();
      EXPECT_TRUE(report.converged()) << report.reason();
      return report.last().contact;
    };
    const auto behind = contacts("y");
    EXPECT_EQ(behind[0].nodes, 0);
    EXPECT_EQ(behind[0].force[0], 0);
    EXPECT_EQ(behind[0].dissipated, 0);
    EXPECT_GT(behind[1].force[1], 0.01);
    EXPECT_NEAR(behind[1].force[0], 0, 1e-12);
    const auto half = contacts("x < 1.1 ? y : y + 1");
    EXPECT_GT(half[1].force[1], 0.001);
    EXPECT_NEAR(half[1].force[0], 0, 1e-12);
    EXPECT_LE(std::abs(half[0].force[0]), 0.5 * half[0].force[1] + 1e-9);
  }
}

TEST(Coulomb, ThatAnExpressionDoesNotDragIsSaid) {
  const auto warnings = [](const std::string& distance, const std::string& law) {
    SceneText scene = block2("on = \"bottom\"\nshape = \"expression\"\ndistance = \"" + distance + "\"\n" + law, 1);
    Driver driver(parse_scene(std::string(scene) + "[steps]\ncount = 2\n", "test.toml", "."));
    return driver.solve().warnings;
  };
  const std::string rough = "type = \"coulomb\"\nfriction = 0.3", smooth = "type = \"contact\"";
  const auto says = testing::Contains(testing::AllOf(testing::HasSubstr("obstacle.0.distance"),
                                                     testing::HasSubstr("friction takes the obstacle to be at rest")));
  EXPECT_THAT(warnings("y + 0.001*t*(1 + x)", rough), says);
  EXPECT_THAT(warnings("y + 0.001*(1 + x)", rough), testing::Not(says));
  EXPECT_THAT(warnings("y + 0.001*t*(1 + x)", smooth), testing::Not(says));
}

TEST(Coulomb, BadInputIsRefusedWithItsPlace) {
  expect_refused(block2(coulomb(on_plane, "-0.1"), 0), "obstacle.0.friction");
  expect_refused(block2(coulomb(on_plane, "\"x - 1\""), 0), "expected a number in [0, inf)");
  expect_refused(block2(coulomb(on_plane, "\"log(x - 1)\""), 0), "obstacle.0.friction");
  expect_refused(block2(coulomb(on_plane, "nan"), 0), "obstacle.0.friction");
  expect_refused(block2(std::string(on_plane) + "\ntype = \"coulomb\"", 0), "needs 'friction'");
  SceneText scalar = block2(coulomb(on_plane, "0.1"), 0);
  scalar.body = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\nequation = \"diffusion\"";
  scalar.fixes = {"on = \"top\"\nvalue = 0"};
  expect_refused(scalar, "is for elastic bodies");
  SceneText held = block2(coulomb(on_plane, "0.1"), 0);
  held.fixes.push_back("on = \"bottom\"\nvalue = [\"free\", 0]");
  expect_refused(held, "prescribes the displacement along the normal");
}

}  // namespace
}  // namespace signorini::test
