#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/estimators/estimates.hpp"

namespace signorini::test {
namespace {

using ::testing::HasSubstr;

constexpr double rounding = 1e-12;

const std::string diffusion = "equation = 'diffusion'\n";

std::string membrane(const std::string& cells = "[4, 4]") {
  return tables::block("m", "[-1, -1]", "[1, 1]", cells, diffusion) + tables::fix("m", "boundary", "0");
}

/// The true gap J(v) - J(u) is known up to what the bounds of a much finer mesh leave open.
struct TrueGap {
  double least, most;
};

TrueGap true_gap(const Estimated& coarse, const Estimated& fine) {
  const double least = coarse.lifted() - fine.lifted();
  return {least, least + fine.estimate.upper};
}

void expect_bounds(const Estimated& found, const TrueGap& gap) {
  EXPECT_LT(found.estimate.imbalance, rounding);
  EXPECT_LE(found.estimate.lower, gap.most);
  EXPECT_GE(found.estimate.upper, gap.least);
  const EstimateParts& p = found.estimate.parts;
  EXPECT_NEAR(p.discretisation + p.algebra + p.contact + p.oscillation, found.estimate.upper,
              1e-12 * found.estimate.upper);
}

/// A strip on a flat floor: -u'' = -f with u(0) = 0 touches at -g from c = sqrt(2 g / f) on, and J = f^2 c^3 / 3 - 2 f
/// g.
TEST(Certificate, ContainsTheErrorOfAMembraneOnAFlatFloor) {
  const double f = 3, g = 0.5, c = std::sqrt(2 * g / f), J = f * f * c * c * c / 3 - 2 * f * g;
  const std::string scene = tables::block("m", "[0, 0]", "[2, 1]", "[4, 2]", diffusion) +
                            tables::fix("m", "left", "0") + tables::load("m", "-3") + tables::floor("m", "-0.5");
  for (const int refinements : {1, 2, 3, 4}) {
    SCOPED_TRACE(refinements);
    const Estimated found = estimated(scene, refinements);
    const double gap = found.energy - J;
    EXPECT_TRUE(found.estimate.guaranteed);
    EXPECT_GT(found.estimate.parts.contact, 0);
    expect_bounds(found, {gap, gap});
    EXPECT_LT(found.estimate.upper, 1.6 * gap);
    EXPECT_GT(found.estimate.lower, 0.5 * gap);
  }
}

/// Saint-Venant's torsion of a square: the integral of u is 16 * 0.0351442538 for f = 1 and side 2.
TEST(Certificate, ContainsTheErrorOfTorsion) {
  const double J = -25 * 8 * 0.035144253788;
  for (const int refinements : {0, 1, 2, 3}) {
    const Estimated found = estimated(membrane() + tables::load("m", "5"), refinements);
    const double gap = found.energy - J;
    EXPECT_TRUE(found.estimate.guaranteed);
    expect_bounds(found, {gap, gap});
    EXPECT_LT(found.estimate.upper, 1.2 * gap);
    EXPECT_GT(found.estimate.lower, 0.8 * gap);
  }
}

TEST(Certificate, LiftsAMembraneOverACurvedObstacle) {
  const std::string scene = membrane() + tables::load("m", "-1") + tables::floor("m", "'0.2 - x^2 - y^2'");
  const Estimated fine = estimated(scene, 5);
  for (const int refinements : {1, 2, 3}) {
    const Estimated found = estimated(scene, refinements);
    EXPECT_TRUE(found.estimate.guaranteed);
    EXPECT_GT(found.estimate.lifted, 0) << "nodes alone are admissible";
    const TrueGap gap = true_gap(found, fine);
    expect_bounds(found, gap);
    EXPECT_LT(found.estimate.upper, 1.6 * gap.most);
  }
}

TEST(Certificate, HasOscillationsOfLoads) {
  const std::string scene = tables::block("m", "[-1, -1]", "[1, 1]", "[4, 4]", diffusion) +
                            tables::fix("m", "left", "0") + tables::load("m", "'1 + x + 2 * y'") +
                            tables::load("m", "'y'", "right");
  const Estimated fine = estimated(scene, 5), found = estimated(scene, 2);
  EXPECT_TRUE(found.estimate.guaranteed);
  EXPECT_GT(found.estimate.parts.oscillation, 0);
  expect_bounds(found, true_gap(found, fine));
  EXPECT_LT(found.estimate.upper, 1.6 * (found.energy - fine.energy));
}

TEST(Certificate, ContainsTheErrorOfAMembraneInSpace) {
  const std::string scene = tables::block("m", "[-1, -1, -1]", "[1, 1, 1]", "[2, 2, 2]", diffusion) +
                            tables::fix("m", "boundary", "0") + tables::load("m", "-8") + tables::floor("m", "-0.5");
  const Estimated fine = estimated(scene, 4, "1e-8"), found = estimated(scene, 2);
  EXPECT_TRUE(found.estimate.guaranteed);
  const TrueGap gap = true_gap(found, fine);
  expect_bounds(found, gap);
  EXPECT_LT(found.estimate.upper, 1.6 * gap.most);
}

/// Harmonic, and prescribed at the boundary: quadratic elements have the solution, linear ones have not.
TEST(Certificate, FindsNoErrorOfWhatQuadraticElementsHold) {
  for (const int order : {1, 2}) {
    const std::string scene =
        tables::block("m", "[0, 0]", "[1, 2]", "[2, 3]", diffusion + "order = " + std::to_string(order) + "\n") +
        tables::fix("m", "boundary", "'x^2 - y^2 + x'");
    const Estimated found = estimated(scene, 1, "1e-12");
    EXPECT_EQ(found.estimate.guaranteed, order == 2) << "prescribed values are quadratic";
    EXPECT_EQ(found.estimate.relative_upper() < 1e-9, order == 2);
    EXPECT_LT(found.estimate.imbalance, rounding);
  }
}

/// Of the quadratic elements, which are fewer than the mesh has simplices.
TEST(Certificate, HasSharesOfQuadraticElements) {
  const std::string scene = tables::block("b", "[0, 0]", "[2, 1]", "[4, 3]", "order = 2\nyoung = 1\npoisson = 0.3\n") +
                            tables::fix("b", "left", "[0, 0]") + tables::load("b", "[0, -0.1]", "top") +
                            tables::plane("b", "bottom", "[0, -0.1]", "[0, 1]");
  const Estimated found = estimated(scene, 1);
  ASSERT_EQ(found.estimate.of_element.size(), 2u * 4 * 3 * 4);
  double sum = 0;
  for (const double share : found.estimate.of_element) sum += share;
  EXPECT_NEAR(sum, found.estimate.upper, 1e-12 * found.estimate.upper);
}

/// A block that is pressed onto a floor and drawn along it: some of it slips, some sticks. With one way to slip
/// friction at nodes takes what it takes between them.
TEST(Certificate, ContainsTheErrorWithGivenFriction) {
  for (const int order : {1, 2}) {
    SCOPED_TRACE(order);
    const std::string scene =
        tables::block("b", "[0, 0]", "[2, 1]", "[4, 2]", fmt::format("order = {}\nyoung = 1\npoisson = 0.3\n", order)) +
        tables::fix("b", "top", "['0.02 * t', -0.03]") +
        "[[obstacle]]\ntype = 'tresca'\nbody = 'b'\non = 'bottom'\nshape = 'plane'\npoint = [0, 0]\nnormal = [0, "
        "1]\nbound = 0.004\n[steps]\ncount = 2\n";
    const Estimated found = estimated(scene, 1), fine = estimated(scene, 4);
    EXPECT_TRUE(found.estimate.guaranteed);
    EXPECT_GT(found.estimate.parts.friction, 0);
    EXPECT_LT(found.estimate.imbalance, rounding);
    const TrueGap gap = true_gap(found, fine);
    EXPECT_LE(found.estimate.lower, gap.most);
    EXPECT_GE(found.estimate.upper, gap.least);
    EXPECT_LE(found.estimate.upper, (order == 1 ? 3 : 4) * found.estimate.lower);
  }
}

TEST(Certificate, ContainsTheErrorWithGivenFrictionInSpace) {
  const std::string scene =
      tables::block("b", "[0, 0, 0]", "[2, 1, 1]", "[4, 2, 2]") + tables::fix("b", "top", "[0.03, 0, -0.03]") +
      "[[obstacle]]\ntype = 'tresca'\nbody = 'b'\non = 'bottom'\nshape = 'plane'\npoint = [0, 0, 0]\nnormal = [0, 0, "
      "1]\nbound = 0.002\n";
  const Estimated found = estimated(scene, 0), fine = estimated(scene, 2, "1e-9");
  EXPECT_TRUE(found.estimate.guaranteed);
  EXPECT_LE(found.estimate.upper, 6 * found.estimate.lower) << "the coarsest mesh";
  const TrueGap gap = true_gap(found, fine);
  EXPECT_LE(found.estimate.lower, gap.most);
  EXPECT_GE(found.estimate.upper, gap.least);
}

/// Pressed evenly: the solution is linear, and no error is left.
TEST(Certificate, FindsNoErrorWhereThereIsNone) {
  const std::string plane = tables::block("b", "[0, 0]", "[2, 1]", "[4, 3]") + tables::load("b", "[0, -0.1]", "top") +
                            tables::plane("b", "bottom", "[0, 0]", "[0, 1]") +
                            "[[fix]]\nbody = 'b'\non = 'left'\nvalue = [0, 'free']\n";
  const std::string space = tables::block("b", "[0, 0, 0]", "[2, 1, 1]", "[2, 2, 1]") +
                            tables::load("b", "[0, 0, -0.1]", "top") +
                            tables::plane("b", "bottom", "[0, 0, 0]", "[0, 0, 1]") +
                            "[[fix]]\nbody = 'b'\non = 'left'\nvalue = [0, 'free', 'free']\n" +
                            "[[fix]]\nbody = 'b'\non = 'front'\nvalue = ['free', 0, 'free']\n";
  for (const std::string& scene : {plane, space}) {
    const Estimated found = estimated(scene, 1, "1e-12");
    EXPECT_LT(found.estimate.relative_upper(), 1e-9);
    EXPECT_LT(found.estimate.relative_lower(), 1e-9);
  }
}

std::string clamped_block(const std::string& poisson) {
  return tables::block("b", "[0, 0]", "[2, 1]", "[4, 2]", "order = 1\nyoung = 1\npoisson = " + poisson + "\n") +
         tables::fix("b", "left", "[0, 0]") + tables::load("b", "[0, -0.02]", "top") +
         tables::plane("b", "bottom", "[0, -0.02]", "[0, 1]");
}

TEST(Certificate, ContainsTheErrorOfAnElasticBlockOnAPlane) {
  for (const std::string poisson : {"0.0", "0.3", "0.45"}) {
    SCOPED_TRACE(poisson);
    const Estimated fine = estimated(clamped_block(poisson), 5, "1e-8");
    for (const int refinements : {1, 2, 3}) {
      const Estimated found = estimated(clamped_block(poisson), refinements);
      EXPECT_TRUE(found.estimate.guaranteed);
      expect_bounds(found, true_gap(found, fine));
      EXPECT_LT(found.estimate.upper, 6 * found.estimate.lower);
    }
  }
}

TEST(Certificate, ContainsTheErrorOfACubeInSpace) {
  const std::string scene = tables::block("b", "[0, 0, 0]", "[1, 1, 1]", "[2, 2, 2]") +
                            tables::fix("b", "top", "[0, 0, -0.03]") + "[[obstacle]]\ntype = 'contact'\nbody = 'b'\n" +
                            "on = 'bottom'\nshape = 'expression'\nnormal = [0, 0, 1]\n" +
                            "distance = 'z + 0.2 * ((x - 0.4)^2 + (y - 0.5)^2)'\n";
  const Estimated fine = estimated(scene, 3, "1e-8");
  for (const int refinements : {1, 2}) {
    const Estimated found = estimated(scene, refinements);
    EXPECT_TRUE(found.estimate.guaranteed);
    EXPECT_GT(found.estimate.parts.contact, 0);
    expect_bounds(found, true_gap(found, fine));
    EXPECT_LT(found.estimate.upper, 6 * found.estimate.lower);
  }
}

TEST(Certificate, IsLessSharpWithoutTheCorrectiveSolve) {
  const Estimated sharp = estimated(clamped_block("0.3"), 2), cheap = estimated(clamped_block("0.3"), 2, "1e-10", true);
  EXPECT_EQ(cheap.estimate.lower, sharp.estimate.lower);
  EXPECT_GT(cheap.estimate.upper, sharp.estimate.upper);
  EXPECT_LT(cheap.estimate.imbalance, rounding);
}

TEST(Certificate, DoesNotDependOnUnits) {
  const auto scene = [](double length, double young) {
    const auto point = [&](double x, double y) { return fmt::format("[{}, {}]", x * length, y * length); };
    return tables::block("b", point(0, 0), point(2, 1), "[4, 2]",
                         fmt::format("order = 1\nyoung = {}\npoisson = 0.3\n", young)) +
           tables::fix("b", "left", "[0, 0]") + tables::load("b", fmt::format("[0, {}]", -0.02 * young), "top") +
           tables::plane("b", "bottom", point(0, -0.02), "[0, 1]");
  };
  const Estimate here = estimated(scene(1, 1), 1).estimate, other = estimated(scene(1e-3, 2.1e11), 1).estimate;
  EXPECT_NEAR(other.relative_lower(), here.relative_lower(), 1e-8 * here.relative_lower());
  EXPECT_NEAR(other.relative_upper(), here.relative_upper(), 1e-8 * here.relative_upper());
}

std::string reason(const std::string& scene) {
  const Estimate found = estimated(scene, 1).estimate;
  EXPECT_FALSE(found.guaranteed);
  return found.reasons.empty() ? "" : found.reasons.front();
}

TEST(Certificate, SaysWhatItDoesNotCover) {
  const std::string block = tables::block("b", "[0, 0]", "[1, 1]", "[2, 2]");
  EXPECT_THAT(reason(membrane() + tables::load("m", "'exp(x)'")), HasSubstr("not linear within elements"));
  EXPECT_THAT(reason(membrane() + tables::load("m", "-1") + tables::floor("m", "'-0.5 + 0.1 * x^3'")),
              HasSubstr("neither linear nor quadratic"));
  EXPECT_THAT(
      reason(tables::block("m", "[-1, -1]", "[1, 1]", "[4, 4]", diffusion) + tables::fix("m", "boundary", "'x^2'")),
      HasSubstr("prescribed values are not linear"));
  EXPECT_THAT(reason(block + tables::fix("b", "top", "[0, 0]") + tables::load("b", "['x', 0]")),
              HasSubstr("body force"));
  EXPECT_THAT(reason(block + tables::fix("b", "top", "[0, -0.01]") +
                     "[[obstacle]]\ntype = 'coulomb'\nbody = 'b'\non = 'bottom'\nshape = 'plane'\npoint = [0, 0]\n"
                     "normal = [0, 1]\nfriction = 0.2\n"),
              HasSubstr("follows the pressure"));
}

}  // namespace
}  // namespace signorini::test
