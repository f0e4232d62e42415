// Estimates by recovered stresses, and by an estimator of a plugin: against energies of much finer meshes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "apps/scenes/tables.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"

namespace signorini::test {
namespace {

using testing::HasSubstr;

const std::string diffusion = "equation = 'diffusion'\n";

std::string elastic(int order, const std::string& more = "") {
  return "young = 1\npoisson = 0.3\norder = " + std::to_string(order) + "\n" + more;
}

std::string of_order(int order) { return diffusion + "order = " + std::to_string(order) + "\n"; }

/// u = (r^2 - 1) / 2 - log r outside of the unit circle, and in contact within it.
std::string radial(int order) {
  return tables::block("m", "[-1.5, -1.5]", "[1.5, 1.5]", "[6, 6]", of_order(order)) +
         tables::fix("m", "boundary", "'(x^2 + y^2 - 1) / 2 - log(x^2 + y^2) / 2'") + tables::load("m", "-2") +
         tables::floor("m", "0");
}

/// Pressed on the edge of a step.
std::string step(int order) {
  return tables::block("b", "[0, 0]", "[1, 1]", "[4, 4]", elastic(order)) + tables::fix("b", "top", "[0, -0.01]") +
         "[[obstacle]]\ntype = 'contact'\nbody = 'b'\nwhere = 'y < 1e-6 && x > 0.5 - 1e-6'\nshape = 'plane'\n"
         "point = [0, 0]\nnormal = [0, 1]\n";
}

std::string half_disk(const std::string& material, const std::string& center = "[0, 0]") {
  return "[[body]]\nname = 'b'\nshape = 'half_disk'\ncenter = " + center + "\nradius = 1\nsize = 0.25\n" + material;
}

std::string hertz(int order, const std::string& plane) {
  return half_disk(elastic(order, "plane = '" + plane + "'\n")) + tables::fix("b", "flat", "[0, -0.02]") +
         tables::plane("b", "curved", "[0, -1]", "[0, 1]");
}

/// On an elastic block.
std::string two_bodies(int order) {
  return half_disk(elastic(order), "[0, 1]") +
         tables::block("k", "[-1.5, -1.5]", "[1.5, 0]", "[9, 5]", elastic(order)) +
         tables::fix("b", "flat", "[0, -0.02]") + tables::fix("k", "bottom", "[0, 0]") +
         "[[obstacle]]\ntype = 'elastic'\nbody = 'b'\non = 'curved'\nother = 'k'\nother_on = 'top'\n";
}

std::string cube(int order) {
  return tables::block("b", "[0, 0, 0]", "[1, 1, 1]", "[2, 2, 2]", elastic(order)) +
         tables::fix("b", "top", "[0, 0, -0.01]") +
         "[[obstacle]]\ntype = 'contact'\nbody = 'b'\nwhere = 'z < 1e-6 && x > 0.5 - 1e-6'\nshape = 'plane'\n"
         "point = [0, 0, 0]\nnormal = [0, 0, 1]\n";
}

StepReport solved(const std::string& scene, int uniform, const std::string& estimate) {
  Driver driver(
      parse_scene(scene, "test.toml", ".",
                  std::vector<std::string>{"refine.uniform=" + std::to_string(uniform), "solver.estimate=" + estimate,
                                           "solver.tolerance=1e-9", "plugins.path=['" SIGNORINI_ESTIMATORS "']"}));
  return driver.solve().last();
}

/// The estimate over the true error, both in the energy norm.
double effectivity(const StepReport& coarse, const StepReport& fine) {
  return std::sqrt(coarse.estimate->estimated / (coarse.summary.energy - fine.summary.energy));
}

struct Case {
  const char* name;
  std::string (*scene)(int order);
  std::vector<int> uniform[2];  ///< by order
  int finest;
};

class Effectivity : public testing::TestWithParam<Case> {};

TEST_P(Effectivity, IsNearOneOnAllMeshes) {
  const Case& of = GetParam();
  const StepReport fine = solved(of.scene(2), of.finest, "false");
  for (const int order : {1, 2})
    for (const int uniform : of.uniform[order - 1]) {
      const StepReport found = solved(of.scene(order), uniform, "recovery");
      const double index = effectivity(found, fine);
      std::printf("%s, order %d, uniform %d: %.2f\n", of.name, order, uniform, index);
      EXPECT_GT(index, 0.3);
      EXPECT_LT(index, 5);
    }
}

// On coarse meshes the chords of a disk are shorter than its arcs, which changes the energy by more than the elements
// do.
INSTANTIATE_TEST_SUITE_P(
    Recovery, Effectivity,
    testing::Values(Case{"Radial", radial, {{1, 2, 3}, {1, 2}}, 5}, Case{"Step", step, {{0, 1, 2, 3}, {0, 1, 2}}, 6},
                    Case{"Hertz", [](int order) { return hertz(order, "strain"); }, {{2, 3}, {1, 2}}, 5},
                    Case{"Revolution", [](int order) { return hertz(order, "axisymmetric"); }, {{1, 2, 3}, {1, 2}}, 5},
                    Case{"TwoBodies", two_bodies, {{1, 2, 3}, {1, 2}}, 5}, Case{"Cube", cube, {{1, 2}, {0, 1}}, 3}),
    [](const auto& param) { return std::string(param.param.name); });

TEST(Recovery, ClaimsNoBounds) {
  const EstimateReport found = *solved(step(1), 1, "recovery").estimate;
  EXPECT_FALSE(found.guaranteed);
  EXPECT_THAT(found.reasons, testing::ElementsAre("an estimate, no bound"));
  EXPECT_TRUE(std::isnan(found.lower) && std::isnan(found.upper) && std::isnan(found.total));
}

TEST(Recovery, FindsNoErrorInLinearFunctions) {
  const std::string scene = tables::block("m", "[0, 0]", "[2, 1]", "[8, 4]", diffusion) +
                            tables::fix("m", "left", "0") + tables::fix("m", "right", "1");
  EXPECT_LT(solved(scene, 1, "recovery").estimate->estimated, 1e-20);
}

/// A strip of two materials, stretched and held across: the stress across is another in each, and the same everywhere.
TEST(Recovery, DoesNotSmoothAcrossMaterials) {
  for (const int order : {1, 2}) {
    const std::string scene =
        "[[body]]\nname = 'b'\nmesh = '" SIGNORINI_SOURCE_DIR "/tests/estimators/two_materials.msh'\n" +
        elastic(order) + "[[material]]\nbody = 'b'\nvolume = 'stiff'\nyoung = 10\npoisson = 0.2\n" +
        tables::fix("b", "left", "[0, 'free']") + tables::fix("b", "right", "[0.01, 'free']") +
        tables::fix("b", "sides", "['free', 0]");
    const EstimateReport found = *solved(scene, 2, "recovery").estimate;
    EXPECT_LT(found.estimated, 1e-12 * found.energy);
  }
}

/// Two bodies that are pressed on each other evenly: the stress along the contact is another in each.
TEST(Recovery, DoesNotSmoothAcrossBodies) {
  const auto body = [](const char* name, const char* from, const char* to, double young) {
    return tables::block(name, from, to, "[2, 2]",
                         "order = 1\npoisson = 0.3\nplane = 'strain'\nyoung = " + std::to_string(young) + "\n");
  };
  const std::string scene =
      body("a", "[0, 0]", "[1, 1]", 1) + body("b", "[0, 1]", "[1, 2]", 5) + tables::fix("a", "bottom", "['free', 0]") +
      tables::fix("a", "left", "[0, 'free']") + tables::fix("b", "left", "[0, 'free']") +
      tables::fix("a", "right", "[0, 'free']") + tables::fix("b", "right", "[0, 'free']") +
      tables::load("b", "[0, -0.01]", "top") +
      "[[obstacle]]\ntype = 'elastic'\nbody = 'a'\non = 'top'\nother = 'b'\nother_on = 'bottom'\n";
  const EstimateReport found = *solved(scene, 1, "recovery").estimate;
  EXPECT_LT(found.estimated, 1e-12 * found.energy);
}

/// Poisson's ratio near 1/2, where pressures have unknowns of their own.
TEST(Recovery, StaysBoundedForRubber) {
  const auto rubber = [](const char* poisson) {
    return tables::block("b", "[0, 0]", "[1, 1]", "[4, 4]",
                         std::string("young = 1\norder = 2\npoisson = ") + poisson + "\n") +
           tables::fix("b", "top", "[0, -0.01]") + tables::plane("b", "bottom", "[0, 0]", "[0, 1]");
  };
  for (const char* poisson : {"0.49", "0.4999"}) {
    const double index = effectivity(solved(rubber(poisson), 1, "recovery"), solved(rubber(poisson), 4, "false"));
    std::printf("poisson %s: %.2f\n", poisson, index);
    EXPECT_GT(index, 0.3);
    EXPECT_LT(index, 5);
  }
}

/// What bubbles win is the lower bound of the certificate.
TEST(Hierarchical, IsTheLowerBound) {
  for (const int order : {1, 2}) {
    const StepReport fine = solved(step(2), 6, "false"), found = solved(step(order), 2, "hierarchical");
    const StepReport bounds = solved(step(order), 2, "true");
    EXPECT_NEAR(found.estimate->estimated, bounds.estimate->lower, 1e-9 * bounds.estimate->lower);
    EXPECT_FALSE(found.estimate->guaranteed);
    const double index = effectivity(found, fine);
    std::printf("hierarchical, order %d: %.2f\n", order, index);
    EXPECT_GT(index, 0.5);
    EXPECT_LT(index, 2);
  }
}

TEST(PluginEstimator, IsLoadedByItsName) {
  const StepReport fine = solved(step(2), 5, "false");
  for (const int order : {1, 2}) {
    const StepReport found = solved(step(order), 2, "averaging");
    const double index = effectivity(found, fine);
    EXPECT_GT(index, 0.3);
    EXPECT_LT(index, 5);
  }
  try {
    solved(step(1), 0, "averagin");
    ADD_FAILURE() << "there is none of that name";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    EXPECT_THAT(error.what(), HasSubstr("there is no estimator plugin 'averagin', did you mean 'averaging'?"));
  }
}

TEST(PluginEstimator, IsTheOneOfThePage) {
  const auto text = [](const char* file) {
    std::ifstream in(std::string(SIGNORINI_SOURCE_DIR "/") + file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string source = text("tests/estimators/plugin/averaging.cpp");
  EXPECT_THAT(text("docs/own_estimators.md"), HasSubstr("```cpp\n" + source + "```"));
  EXPECT_LE(std::ranges::count(source, '\n'), 60);
}

}  // namespace
}  // namespace signorini::test
