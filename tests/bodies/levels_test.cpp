#include "tests/bodies/scenes.hpp"

// Levels of bodies that touch each other: chosen by the matrix, and kept from step to step.

namespace signorini::test {
namespace {

/// A half disk pushed into a block.
std::string disk_on_block(double push, const std::string& more, const std::string& type = "elastic",
                          const std::string& of_pair = "", int order = 1) {
  const std::string elastic = material(1, 0.3, order);
  return "[[body]]\nname = \"disk\"\nshape = \"half_disk\"\ncenter = [0, 1]\nradius = 1\nsize = \"0.02 + 0.3 * "
         "sqrt(x^2 + y^2)\"\n" +
         elastic + tables::block("block", "[-1, -1]", "[1, 0]", "[32, 16]", elastic) +
         tables::fix("disk", "flat", fmt::format("[0, {}]", -push)) + tables::fix("block", "bottom", "[0, 0]") +
         pair("disk", "curved", "block", "top", of_pair, type) + more;
}

double force_of(const std::string& text, int most_iterations) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  EXPECT_LE(report.last().summary.iterations, most_iterations);
  expect_opposite(report.last().contact[0]);
  show("{} unknowns, {} iterations\n", report.last().summary.level_unknowns.back(), report.last().summary.iterations);
  return length(report.last().contact[0].force);
}

TEST(LevelsByTheMatrix, LeadToTheSameSolution) {
  for (const int order : {1, 2})
    for (const bool friction : {false, true}) {
      SCOPED_TRACE(fmt::format("order {}, friction {}", order, friction));
      const std::string type = friction ? "elastic_coulomb" : "elastic", of_pair = friction ? "friction = 0.3\n" : "";
      const std::string refine = fmt::format("[refine]\nuniform = {}\n", order == 1 ? 2 : 1);
      const double meshes = force_of(disk_on_block(0.02, refine, type, of_pair, order), 20);
      const double matrix =
          force_of(disk_on_block(0.02, refine + "[solver]\nhierarchy = \"matrix\"\n", type, of_pair, order), 40);
      EXPECT_NEAR(matrix, meshes, 1e-6 * meshes);
    }
}

void expect_as_new(const Driver& kept, const std::string& text) {
  Driver fresh(scene_of(text));
  ASSERT_TRUE(fresh.solve().converged());
  const std::vector<double>&u = kept.solution(), &wanted = fresh.solution();
  ASSERT_EQ(u.size(), wanted.size());
  double size = 0, off = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    size = std::max(size, std::abs(wanted[k]));
    off = std::max(off, std::abs(u[k] - wanted[k]));
  }
  EXPECT_LT(off, 1e-6 * size);
}

// Where jumps are at the same nodes matrices stay, also where bodies part from each other a little.
TEST(Matrices, OfBodiesThatTouchAreKept) {
  for (const std::string refine : {"", "[refine]\nuniform = 2\n"}) {
    SCOPED_TRACE(refine);
    Driver driver(scene_of(disk_on_block(0.02, refine)));
    ASSERT_TRUE(driver.solve().converged());
    EXPECT_GT(driver.report().time.assemblies.stiffness, 0);
    for (const double push : {0.02, 0.019}) {
      driver.scene().fixes[0].value[1] = -push;
      ASSERT_TRUE(driver.solve().converged());
      EXPECT_EQ(driver.report().time.assemblies.stiffness, 0) << push;
      expect_as_new(driver, disk_on_block(push, refine));
    }
    driver.scene().fixes[0].value[1] = -0.05;
    ASSERT_TRUE(driver.solve().converged());
    expect_as_new(driver, disk_on_block(0.05, refine));
  }
}

int iterations(const std::string& text) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  show("{} unknowns, {} iterations\n", report.last().summary.level_unknowns.back(), report.last().summary.iterations);
  return report.last().summary.iterations;
}

// As ball_on_block.toml: beside the same block under a rigid ball, and the same ball on a rigid block.
TEST(Cycles, OfTwoBodiesAreAThirdMoreThanThoseOfOneAtMost) {
  const std::string ball =
      "[[body]]\nname = \"ball\"\nshape = \"half_ball\"\ncenter = [0, 0, 1]\nradius = 1\nsize = \"0.06 + 0.35 * "
      "sqrt(x^2 + y^2 + z^2)\"\n" +
      material(1) + tables::fix("ball", "flat", "[0, 0, -0.03]");
  const std::string block = tables::block("block", "[-1, -1, -1]", "[1, 1, 0]", "[12, 12, 6]", material(1)) +
                            tables::fix("block", "bottom", "[0, 0, 0]");
  const std::string refine = "[refine]\nuniform = 1\n";
  const int two = iterations(ball + block + pair("ball", "curved", "block", "top") + refine);
  const int rigid_ball = iterations(block +
                                    "[[obstacle]]\ntype = \"contact\"\nbody = \"block\"\non = \"top\"\nshape = "
                                    "\"sphere\"\ncenter = [0, 0, 0.985]\nradius = 1\n" +
                                    refine);
  const int rigid_block = iterations(ball + tables::plane("ball", "curved", "[0, 0, -0.015]", "[0, 0, 1]") + refine);
  EXPECT_LE(two, 1.3 * std::max(rigid_ball, rigid_block));
}

// Levels that the matrix makes below the coarsest mesh lose little against a factorisation there: each body moves by
// itself on them.
TEST(Cycles, AreAsFewWithLevelsBelowTheCoarsestMesh) {
  const std::string size = "size = \"0.005 + 0.15 * sqrt(x^2 + y^2)\"\n";
  const std::string cylinders =
      "[[body]]\nname = \"upper\"\nshape = \"half_disk\"\ncenter = [0, 1]\nradius = 1\nyoung = 1\npoisson = 0.3\n" +
      size + "[[body]]\nname = \"lower\"\nshape = \"disk\"\ncenter = [0, -2]\nradius = 2\nyoung = 3\npoisson = 0.25\n" +
      size + tables::fix("upper", "flat", "[0, -0.004]") +
      "[[fix]]\nbody = \"lower\"\nwhere = \"y < -3\"\nvalue = [0, 0]\n" + pair("upper", "curved", "lower", "boundary") +
      "[refine]\nuniform = 1\n";
  const int factorised = iterations(cylinders + "[solver]\nalgebraic = false\n");
  EXPECT_LE(iterations(cylinders), 1.5 * factorised + 3);
}

// Where bodies touch before anything moves, rounding alone tells whether a rough solution parts them: they stay one
// problem, which is not solved without contact first.
TEST(TouchingBodies, ArePairedFromTheStart) {
  for (const double young : {0.7, 0.8, 0.9, 1.1, 2.0}) {
    SCOPED_TRACE(young);
    Driver driver(scene_of(tables::block("upper", "[-0.4, 0]", "[0.4, 1]", "[1, 1]", material(young, 0.49, 2)) +
                           tables::block("lower", "[-0.5, -0.6]", "[0.7, 0]", "[1, 1]", material(6.7, 0.49, 2)) +
                           tables::fix("lower", "bottom", "[0, 0]") +
                           tables::fix("upper", "top", "[\"0\", \"-0.034 * t\"]") +
                           pair("upper", "bottom", "lower", "top", "friction = 0.16\n", "elastic_coulomb") +
                           "[refine]\nuniform = 0\n[steps]\ncount = 2\n"));
    for (const StepReport& step : driver.solve().steps) {
      EXPECT_EQ(step.summary.outcome, Outcome::converged);
      EXPECT_EQ(step.summary.stages.size(), 1u);
    }
  }
}

}  // namespace
}  // namespace signorini::test
