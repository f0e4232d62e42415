// Friction in space on paths that turn: what slips follows the turn by and by. A closed form, and ten times the steps.
#include "driver/driver.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

/// A block of edges 1 on the floor with its top moved.
SceneText block(const std::string& friction, const std::string& top, int refinements) {
  return {
      .body = "shape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, 1]\ncells = [2, 2, 2]\norder = 1\nyoung = 1\npoisson = 0",
      .fixes = {"on = \"top\"\nvalue = " + top},
      .obstacle =
          "type = \"coulomb\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
          "friction = " +
          friction,
      .refinements = refinements};
}

/// Shear stresses on a horizontal plane, as expressions: what has to act on the sides to have them uniform.
std::vector<std::string> shear_on_sides(const std::string& x, const std::string& y) {
  const auto side = [](const char* on, const std::string& stress) {
    return fmt::format("on = \"{}\"\nvalue = [0, 0, \"{}\"]", on, stress);
  };
  return {side("right", x), side("left", "-(" + x + ")"), side("back", y), side("front", "-(" + y + ")")};
}

const Report& solve(Driver& driver) {
  const Report& report = driver.solve();
  for (const StepReport& step : report.steps) EXPECT_TRUE(step.summary.converged()) << step.summary.reason;
  EXPECT_TRUE(report.failed.empty());
  return report;
}

constexpr double friction = 0.3, pressure = 0.03, shear = 0.5, limit = friction * pressure;

// A block that slips as a whole is dragged like a weight on a leash, whose length is the shear that friction bears. Its
// hand goes along x first and then along y: the weight follows on a tractrix, and at a way y from the turn the leash
// points along (1/cosh(y/length), tanh(y/length)).
double off_the_tractrix(int steps) {
  constexpr double length = limit / shear, way = 2 * length;
  const std::string y = fmt::format("max(0, (t - 0.2)/0.8) * {}", way), part = fmt::format("({})/{}", y, length);
  SceneText scene = block(fmt::format("{}", friction),
                          fmt::format("[\"{} * min(1, t/0.2)\", \"{}\", {}]", 3 * length, y, -pressure), 0);
  scene.loads = shear_on_sides(fmt::format("{}/cosh({})", limit, part), fmt::format("{}*tanh({})", limit, part));
  std::string at = "0.2";
  for (int k = 1; k <= steps; ++k) at += fmt::format(", {:.17g}", 0.2 + 0.8 * k / steps);
  Driver driver(parse_scene(std::string(scene) + "[steps]\nat = [" + at + "]\n", "turn.toml", "."));
  double largest = 0;
  for (const StepReport& step : solve(driver).steps) {
    const double gone = std::max(0.0, (step.t - 0.2) / 0.8) * way;
    const auto& force = step.contact[0].tangential_force;
    EXPECT_EQ(step.contact[0].stick_nodes, 0);
    EXPECT_NEAR(std::hypot(force[0], force[1]), limit, 1e-3 * limit);
    const double angle = std::atan2(-force[1], -force[0]), expected = std::atan(std::sinh(gone / length));
    largest = std::max(largest, std::abs(angle - expected));
  }
  return largest;
}

TEST(TurningFriction, DragsABlockAlongATractrix) {
  Errors angle;
  for (const int steps : {5, 10, 20}) {
    angle.add(off_the_tractrix(steps));
    show("{} steps after the turn: direction off by {:.4f}\n", steps, angle.value.back());
  }
  EXPECT_GE(angle.mean_order(), 0.9);
  EXPECT_LE(angle.value.back(), 0.05);
}

/// Tangential forces at the nodes, when the top has gone along an arc, and which nodes slip.
struct Arc {
  std::vector<Point<3>> force;
  std::vector<bool> slips;
  double dissipated;
};

Arc along_an_arc(int steps) {
  SceneText scene = block("0.3", "[\"0.03*sin(2.5*t)\", \"0.03*(1 - cos(2.5*t))\", -0.03]", 1);
  scene.body =
      "shape = \"box\"\nfrom = [0, 0, 0]\nto = [2, 1, 1]\ncells = [4, 2, 2]\norder = 1\nyoung = 1\npoisson = 0.3";
  Driver driver(parse_scene(std::string(scene) + fmt::format("[steps]\ncount = {}\n", steps), "arc.toml", "."));
  Arc arc{{}, {}, solve(driver).last().contact[0].dissipated};
  driver.visit(0, [&]<int D, int B>(const BodyRun<D, B>& run) {
    if constexpr (B == 3)
      for (const ContactNode<3>& node : run.results().contact.nodes) {
        arc.force.push_back(node.tangential);
        arc.slips.push_back(node.contact && !node.sticks);
      }
  });
  return arc;
}

// Stick and slip side by side: the directions at the nodes against ten times as many steps.
TEST(TurningFriction, OnAnArcHasTheDirectionsOfTenTimesAsManySteps) {
  constexpr int steps = 16;
  const Arc reference = along_an_arc(10 * steps);
  double before = infinity;
  for (const int count : {steps / 2, steps}) {
    const Arc arc = along_an_arc(count);
    double largest = 0, size = 0, angle = 0;
    int slips = 0;
    for (std::size_t k = 0; k < arc.force.size(); ++k) {
      const Point<3>&f = arc.force[k], &g = reference.force[k];
      size = std::max(size, norm<3>(g));
      largest = std::max(largest, std::hypot(f[0] - g[0], f[1] - g[1]));
      if (!arc.slips[k] || !reference.slips[k]) continue;
      ++slips;
      angle = std::max(angle, std::abs(std::atan2(f[0] * g[1] - f[1] * g[0], f[0] * g[0] + f[1] * g[1])));
    }
    show("{} steps: {} of {} nodes slip, directions off by {:.3f}, forces by {:.3f}, dissipated {:.3f}\n", count, slips,
         arc.force.size(), angle, largest / size, arc.dissipated / reference.dissipated);
    EXPECT_GT(slips, 10);
    EXPECT_LT(angle, before);
    before = angle;
    if (count < steps) continue;
    EXPECT_LE(angle, 0.1);
    EXPECT_LE(largest, 0.1 * size);
  }
}

// A plane that slides under the block, whose top is held: it follows while the shear is below mu p, then the plane
// slides on under it. Both are exact with linear elements.
TEST(TurningFriction, ASlidingPlaneDragsABlockUntilItSlides) {
  constexpr double way = 2.5 * limit / shear;
  const Point<3> along{0.6, -0.8, 0};
  const std::string stress = fmt::format("-min({}, {}*t)", limit, shear * way);
  SceneText scene = block(fmt::format("{}", friction), fmt::format("[0, 0, {}]", -pressure), 1);
  scene.obstacle = fmt::format(
      "type = \"coulomb\"\nfriction = {}\non = \"bottom\"\nshape = \"plane\"\nnormal = [0, 0, 1]\n"
      "point = [\"{}*t\", \"{}*t\", 0]",
      friction, way * along[0], way * along[1]);
  scene.loads = shear_on_sides(fmt::format("{}*{}", along[0], stress), fmt::format("{}*({})", along[1], stress));
  Driver driver(parse_scene(std::string(scene) + "[solver]\ntolerance = 1e-11\n[steps]\nat = [0.1, 0.35, 0.5, 1]\n",
                            "plane.toml", "."));
  double at_limit = 0;
  driver.solve([&] {
    const StepReport& step = driver.report().last();
    ASSERT_TRUE(step.summary.converged()) << step.summary.reason;
    const double gone = way * step.t, force = std::min(limit, shear * gone), slid = gone - force / shear;
    at_limit = std::max(at_limit, slid);
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(step.contact[0].tangential_force[i], force * along[i], 1e-9 * limit) << step.t;
    EXPECT_EQ(slid > 0 ? step.contact[0].stick_nodes : step.contact[0].slip_nodes, 0) << step.t;
    EXPECT_NEAR(step.contact[0].dissipated, limit * slid, 1e-9 * limit * way);
    const std::vector<double> u = driver.solution(), x = driver.points();
    for (std::size_t k = 0; k < u.size(); k += 3) {
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(u[k + i], (1 - x[k + 2]) * force / shear * along[i], 1e-9 * way) << step.t;
      EXPECT_NEAR(u[k + 2], -pressure * x[k + 2], 1e-9 * pressure);
    }
  });
  EXPECT_GT(at_limit, 0);
}

}  // namespace
}  // namespace signorini::test
