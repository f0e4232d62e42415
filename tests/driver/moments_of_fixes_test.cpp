// What clamps and springs hold against, about the origin: half a body says what the whole one does.
#include "driver/reports/moments.hpp"

#include "tests/bodies/scenes.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

using tables::block, tables::fix;

const std::string pulled = "[[load]]\nbody = \"b\"\non = \"right\"\nforce = ";

Report report_of(const std::string& scene) {
  Driver driver(scene_of(scene));
  EXPECT_TRUE(driver.solve().converged()) << driver.report().reason();
  return driver.report();
}

// A force at the end of a beam is held by its moment about the origin.
TEST(Moments, OfAClampIsThatOfTheLoad) {
  const Report report = report_of(block("b", "[1, 2]", "[5, 3]", "[8, 2]", material(100, 0.3, 2)) +
                                  fix("b", "left", "[0, 0]") + pulled + "[0.1, -0.2]\n");
  const ForceReport& clamp = report.last().reactions[0];
  ASSERT_EQ(clamp.moment.size(), 1);
  EXPECT_NEAR(clamp.moment[0], -(5 * -0.2 - 2.5 * 0.1), 1e-8);
}

TEST(Moments, OfSpringsIsThatOfTheLoad) {
  const Report report = report_of(block("b", "[1, 2]", "[5, 3]", "[8, 2]", material(100, 0.3, 2)) + pulled +
                                  "[0.1, -0.02]\n[[spring]]\nbody = \"b\"\non = \"left\"\nstiffness = [5, 3]\n" +
                                  "[[spring]]\nbody = \"b\"\non = \"bottom\"\nstiffness = 2\n");
  double sum = 0;
  for (const ForceReport& spring : report.last().springs) sum += spring.moment.at(0);
  EXPECT_NEAR(sum, -(5 * -0.02 - 2.5 * 0.1), 1e-8);
}

TEST(Moments, OfHalfABodyIsThatOfTheWhole) {
  const auto box = [](const std::string& from, const std::string& cells, const std::string& rest) {
    return block("b", from, "[3, 3, 5]", cells, material(100, 0.3, 1)) + fix("b", "left", "[0, 0, 0]") +
           "[[load]]\nbody = \"b\"\non = \"right\"\nvalue = [0, -0.01, \"0.02 * (z - 4)\"]\n" + rest;
  };
  const auto moment = [](const std::string& scene) { return report_of(scene).last().reactions[0].moment; };
  const std::vector<double> whole = moment(box("[0, 1, 3]", "[4, 4, 4]", "")),
                            half = moment(box("[0, 1, 4]", "[4, 4, 2]", "[symmetry]\nz = 4\n"));
  ASSERT_EQ(whole.size(), 3);
  ASSERT_EQ(half.size(), 3);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(half[i], whole[i], 1e-4 * std::abs(whole[2])) << i;
}

// Directly: a force and its image across x = 1.
TEST(Moments, CountImages) {
  std::vector<double> moment(1);
  add_moment<2>({{0, 1}}, 1, {2, 3}, {5, 7}, {0, 0}, moment);
  EXPECT_DOUBLE_EQ(moment[0], (2 * 7 - 3 * 5) + (0 * 7 - 3 * -5));
  add_moment<2>({{0, 1}}, 0, {2, 3}, {5, 7}, {2, 3}, moment = {0});
  EXPECT_EQ(moment[0], 0);
}

}  // namespace
}  // namespace signorini::test
