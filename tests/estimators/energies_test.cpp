#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/estimators/estimates.hpp"

/// The true solution's energy J(u), known in closed form, is where the report says: between total - upper and
/// total - lower.
namespace signorini::test {
namespace {

constexpr double rounding = 1e-12;

void expect_within(const EstimateReport& found, double energy) {
  EXPECT_TRUE(found.guaranteed);
  const double least = found.total - found.upper, most = found.total - found.lower;
  EXPECT_LE(least, energy + rounding * found.energy);
  EXPECT_GE(most, energy - rounding * found.energy);
  EXPECT_LT(most - least, 0.2 * std::fabs(energy));
}

/// What the whole program reports.
EstimateReport reported(const std::string& scene, int refinements) {
  Driver driver(parse_scene(
      fmt::format("{}[solver]\ntolerance = 1e-10\nestimate = true\n[refine]\nuniform = {}\n", scene, refinements),
      "test.toml", "."));
  driver.solve();
  const StepReport& last = driver.report().last();
  EXPECT_NEAR(last.estimate->total, last.summary.energy + last.estimate->lifted, 1e-8 * last.estimate->energy);
  return *last.estimate;
}

/// A strip over -g - k (x - 2)^2 with u(0) = 0 and the load -f: it touches from c on, and is f x^2 / 2 + b x before.
TEST(Energies, OfAStripOverAnArchAreWithinTheBounds) {
  const double f = 3, g = 0.5, k = 0.2, c = std::sqrt((g + 4 * k) / (f / 2 + k)), b = 2 * k * (2 - c) - f * c;
  const double free = f * f * c * c * c / 3 + f * b * c * c + b * b * c / 2, rest = 2 - c;
  const double J = free + (2 * k * k - f * k) * rest * rest * rest / 3 - f * g * rest;
  for (const int order : {1, 2})
    for (const int refinements : {2, 3, 4}) {
      const std::string scene =
          tables::block("m", "[0, 0]", "[2, 1]", "[4, 2]", fmt::format("equation = 'diffusion'\norder = {}\n", order)) +
          tables::fix("m", "left", "0") + tables::load("m", "-3") + tables::floor("m", "'-0.5 - 0.2 * (x - 2)^2'");
      const EstimateReport found = reported(scene, refinements);
      expect_within(found, J);
      EXPECT_GT(found.lifted, 0);
    }
}

/// A column of height 1 under its weight, on a plane, or cut in two: the stress is y - 1.
TEST(Energies, OfAColumnAreWithinTheBounds) {
  const std::string material = "order = 1\nyoung = 2\npoisson = 0\n", weight = "[0, -0.3]";
  const std::string one = tables::block("a", "[0, 0]", "[0.7, 1]", "[2, 3]", material) + tables::load("a", weight) +
                          tables::plane("a", "bottom", "[0, 0]", "[0, 1]") +
                          "[[fix]]\nbody = 'a'\non = 'left'\nvalue = [0, 'free']\n";
  const auto piece = [&](const std::string& name, const std::string& from, const std::string& to) {
    return tables::block(name, from, to, "[2, 2]", material) + tables::load(name, weight) +
           fmt::format("[[fix]]\nbody = '{}'\non = 'left'\nvalue = [0, 'free']\n", name);
  };
  const std::string two = piece("a", "[0, 0.5]", "[0.7, 1]") + piece("b", "[0, 0]", "[0.7, 0.5]") +
                          tables::fix("b", "bottom", "[0, 0]") +
                          "[[obstacle]]\ntype = 'elastic'\nbody = 'a'\non = 'bottom'\nother = 'b'\nother_on = 'top'\n";
  for (const std::string& scene : {one, two})
    for (const int refinements : {1, 2}) expect_within(reported(scene, refinements), -0.7 * 0.3 * 0.3 / (2 * 2 * 3));
}

/// The same column, heated: it expands by s.
TEST(Energies, OfAHeatedColumnAreWithinTheBounds) {
  const double E = 2, w = 0.3, s = 0.04, J = -0.7 / 2 * (w * w / (3 * E) + 2 * E * s * s - w * s);
  for (const int order : {1, 2})
    for (const std::string plane : {"strain", "stress"}) {
      const std::string scene =
          tables::block("a", "[0, 0]", "[0.7, 1]", "[2, 3]",
                        fmt::format("order = {}\nplane = '{}'\nyoung = 2\npoisson = 0\nexpansion = 1e-3\n"
                                    "temperature = 40\n",
                                    order, plane)) +
          tables::load("a", "[0, -0.3]") + tables::plane("a", "bottom", "[0, 0]", "[0, 1]") +
          "[[fix]]\nbody = 'a'\non = 'left'\nvalue = [0, 'free']\n";
      expect_within(reported(scene, 2), J);
    }
}

/// A heated block that is held between a wall and an obstacle: meshes must agree about where the energy is.
TEST(Energies, OfHeatedBodiesAgreeOnTwoMeshes) {
  const std::string hot = "order = {}\nyoung = 1\npoisson = 0.3\nexpansion = 1e-3\ntemperature = 50\n";
  for (const int order : {1, 2}) {
    const std::string keys = fmt::format(fmt::runtime(hot), order);
    const std::string cold = fmt::format("order = {}\nyoung = 2\npoisson = 0.2\n", order);
    const std::string plane = tables::block("a", "[0, 0]", "[1, 1]", "[3, 3]", keys) +
                              tables::fix("a", "left", "[0, 0]") + tables::plane("a", "right", "[1.01, 0]", "[-1, 0]");
    const std::string space = tables::block("a", "[0, 0, 0]", "[1, 1, 1]", "[2, 2, 2]", keys) +
                              tables::fix("a", "left", "[0, 0, 0]") +
                              tables::plane("a", "right", "[1.01, 0, 0]", "[-1, 0, 0]");
    const std::string two =
        tables::block("a", "[0, 0]", "[1, 1]", "[3, 3]", keys) +
        tables::block("b", "[0, -1]", "[1, 0]", "[3, 3]", cold) + tables::fix("a", "top", "[0, -0.01]") +
        tables::fix("b", "bottom", "[0, 0]") +
        "[[obstacle]]\ntype = 'elastic'\nbody = 'a'\non = 'bottom'\nother = 'b'\nother_on = 'top'\n";
    for (const auto& [scene, in_space] : {std::pair(plane, false), std::pair(space, true), std::pair(two, false)}) {
      const EstimateReport coarse = reported(scene, in_space ? 0 : 1), fine = reported(scene, in_space ? 1 : 2);
      EXPECT_TRUE(coarse.guaranteed && fine.guaranteed) << scene;
      EXPECT_LE(coarse.total - coarse.upper, fine.total - fine.lower) << scene;
      EXPECT_GE(coarse.total - coarse.lower, fine.total - fine.upper) << scene;
    }
  }
}

TEST(Energies, AreThoseOfTheWholeOfAMirroredBody) {
  const std::string half =
      tables::block("a", "[-0.35, 0]", "[0.35, 1]", "[4, 3]", "order = 1\nyoung = 2\npoisson = 0\n") +
      tables::load("a", "[0, -0.3]") + tables::plane("a", "bottom", "[0, 0]", "[0, 1]") + "[symmetry]\nx = 0\n";
  expect_within(reported(half, 1), -0.7 * 0.3 * 0.3 / (2 * 2 * 3));
}

/// A slender beam, on which conjugate gradients take too many steps.
TEST(Estimate, WarnsWhereTheCorrectiveSolveFails) {
  Driver driver(parse_scene(tables::block("b", "[0, 0]", "[1000, 1]", "[400, 2]") + tables::fix("b", "left", "[0, 0]") +
                                tables::load("b", "[0, -1e-9]", "top") + "[solver]\nestimate = true\n",
                            "test.toml", "."));
  driver.solve();
  ASSERT_TRUE(driver.report().last().estimate);
  EXPECT_TRUE(driver.report().last().estimate->guaranteed);
  EXPECT_TRUE(std::ranges::any_of(driver.report().warnings,
                                  [](const Warning& warning) { return warning.id == "bound-not-sharp"; }));
}

}  // namespace
}  // namespace signorini::test
