// The work of friction where what presses grows within steps, and where it does not: closed forms.
#include "driver/driver.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

/// A block, 2 wide, with shear modulus 1/2: uniform pressure 0.03 `press`, shear 0.003 `slide`, and all of the bottom
/// slips by (0.02 - 0.006) `slide`, for the shear is friction's.
double dissipated(const std::string& press, const std::string& slide, const std::string& at) {
  const std::string scene =
      SceneText{.body =
                    "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\norder = 1\nyoung = 1\n"
                    "poisson = 0",
                .fixes = {fmt::format("on = \"top\"\nvalue = [\"0.02 * {}\", \"-0.03 * {}\"]", slide, press)},
                .loads = {fmt::format("on = \"right\"\nvalue = [0, \"0.003 * {}\"]", slide),
                          fmt::format("on = \"left\"\nvalue = [0, \"-0.003 * {}\"]", slide)},
                .obstacle =
                    "type = \"coulomb\"\nfriction = 0.1\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\n"
                    "normal = [0, 1]",
                .refinements = 1};
  Driver driver(parse_scene(scene + "[solver]\ntolerance = 1e-11\n[steps]\nat = [" + at + "]\n", "test.toml", "."));
  return driver.solve().last().contact[0].dissipated;
}

TEST(Dissipated, GrowsWithThePressureWithinAStep) {
  for (const char* at : {"1", "0.5, 1", "0.1, 0.3, 0.7, 1"}) EXPECT_NEAR(dissipated("t", "t", at), 4.2e-5, 1e-10) << at;
}

TEST(Dissipated, UnderAConstantPressureItIsForceTimesWay) {
  for (const char* at : {"0.5, 1", "0.5, 0.75, 1"})
    EXPECT_NEAR(dissipated("min(2 * t, 1)", "max(2 * t - 1, 0)", at), 8.4e-5, 1e-10) << at;
}

/// A block slides by 1 under a force of 25, and by 1 more while it is lifted.
Report lifted(double by) {
  const std::string scene =
      SceneText{.body = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [10, 4]\ncells = [5, 2]\nyoung = 1000\npoisson = 0",
                .fixes = {fmt::format("on = \"top\"\nvalue = [\"max(4 * t - 1, 0)\", \"t <= 0.5 ? "
                                      "-0.01 * min(4 * t, 1) : -0.01 + {} * (4 * t - 2)\"]",
                                      by)},
                .obstacle =
                    "type = \"coulomb\"\nfriction = 0.2\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\n"
                    "normal = [0, 1]"};
  return Driver(parse_scene(scene + "[steps]\ncount = 4\n", "test.toml", ".")).solve();
}

// Half of the force by the way, and shear of 0.005 that goes back, whether contact opens at the end of the step or a
// little before.
TEST(Dissipated, CountsWhatOpensInTheStep) {
  for (const double by : {0.00999, 0.0101, 0.011}) {
    const Report report = lifted(by);
    EXPECT_EQ(report.steps.at(2).contact[0].nodes > 0, by < 0.01) << by;
    EXPECT_NEAR(report.steps.at(2).contact[0].dissipated_in_step, 0.5 * 5 * 1.005, 0.01) << by;
  }
}

}  // namespace
}  // namespace signorini::test
