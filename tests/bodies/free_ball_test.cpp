#include "tests/bodies/scenes.hpp"

// A ball that nothing but a flat elastic block holds: few of its nodes touch, whose own normals are inclined.

namespace signorini::test {
namespace {

struct Units {
  double length = 1, stress = 1;
};

/// Pressed down by a load on all of it.
std::string ball_on_block(const char* cells, double size, double friction, const Units& in = {}) {
  const double l = in.length;
  return fmt::format(
             "[[body]]\nname = \"ball\"\nshape = \"ball\"\ncenter = [0, 0, {0}]\nradius = {0}\nsize = {1}\nyoung = "
             "{2}\npoisson = 0.3\n[[load]]\nbody = \"ball\"\nvalue = [0, 0, {3}]\n",
             1.24 * l, size * l, 0.25 * in.stress, -0.00078 * in.stress / l) +
         fmt::format(
             "[[body]]\nname = \"low\"\nshape = \"box\"\nfrom = [{0}, {0}, {1}]\nto = [{2}, {2}, 0]\ncells = {3}\n"
             "young = {4}\npoisson = 0\n",
             -1.5 * l, -l, 1.5 * l, cells, 22.8 * in.stress) +
         tables::fix("low", "bottom", "[0, 0, 0]") +
         (friction > 0
              ? pair("ball", "boundary", "low", "top", fmt::format("friction = {}\n", friction), "elastic_coulomb")
              : pair("ball", "boundary", "low", "top")) +
         tables::probe("top", "ball", fmt::format("[0, 0, {}]", 2.48 * l));
}

/// Displacement of the ball's top, over the unit of length.
std::vector<double> moved(const std::string& text, const Units& in = {}) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  EXPECT_LE(report.last().summary.iterations, 60);
  const std::vector<double>& force = report.last().contact[0].force;
  for (const int i : {0, 1}) EXPECT_NEAR(force[i], 0, 1e-6 * force[2]);
  std::vector<double> out = report.last().probes[0].value;
  for (double& u : out) u /= in.length;
  return out;
}

TEST(FreeBall, DoesNotRollOrSlideAway) {
  for (const double friction : {0.0, 0.05})
    for (const auto& [cells, size] : {std::pair{"[2, 2, 1]", 1.2}, {"[2, 2, 2]", 0.8}, {"[4, 4, 2]", 0.8}}) {
      SCOPED_TRACE(fmt::format("{} {}", friction, cells));
      const std::vector<double> top = moved(ball_on_block(cells, size, friction));
      show("{:.3g}\n", fmt::join(top, ", "));
      for (const int i : {0, 1}) EXPECT_NEAR(top[i], 0, 0.005);
      EXPECT_LT(top[2], -0.05);
    }
}

TEST(FreeBall, MovesAlikeInAnyUnits) {
  const std::vector<double> here = moved(ball_on_block("[4, 4, 2]", 0.8, 0.05));
  for (const Units in : {Units{1000, 1}, Units{1e-3, 1e6}, Units{25.4, 0.0069}}) {
    const std::vector<double> there = moved(ball_on_block("[4, 4, 2]", 0.8, 0.05, in), in);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(there[i], here[i], 1e-6);
  }
}

}  // namespace
}  // namespace signorini::test
