#include "core/mesh/stretch.hpp"

#include <gtest/gtest.h>

#include "core/mesh/structured.hpp"

namespace signorini {
namespace {

constexpr double limit = 1.45;

TEST(Stretch, CellsOfACubeAndSomewhatLongerOnesDoNotCount) {
  EXPECT_EQ(stretched_part(rectangle({0, 0}, {1, 1}, {3, 3}), limit), 0);
  EXPECT_EQ(stretched_part(box({0, 0, 0}, {1, 1, 1}, {3, 3, 3}), limit), 0);
  EXPECT_EQ(stretched_part(rectangle({0, 0}, {3, 1}, {3, 3}), limit), 0);
  EXPECT_EQ(stretched_part(box({0, 0, 0}, {3, 1, 1}, {3, 3, 3}), limit), 0);
  EXPECT_EQ(stretched_part(box({0, 0, 0}, {4, 4, 1}, {3, 3, 3}), limit), 0);
}

// (a^2 + 1)^(1/2) / a^(1/2) over 2^(1/2) and the like, whatever the direction.
TEST(Stretch, CellsFourTimesAsLongOrEightTimesAsFlatCountInAnyUnits) {
  for (const double unit : {1e-150, 1.0, 1e90}) {
    EXPECT_EQ(stretched_part(rectangle({0, 0}, {4 * unit, unit}, {3, 3}), limit), 1);
    EXPECT_EQ(stretched_part(rectangle({0, 0}, {unit, 4 * unit}, {3, 3}), limit), 1);
    EXPECT_EQ(stretched_part(box({0, 0, 0}, {unit, 4 * unit, unit}, {3, 3, 3}), limit), 1);
    EXPECT_EQ(stretched_part(box({0, 0, 0}, {8 * unit, 8 * unit, unit}, {3, 3, 3}), limit), 1);
  }
}

TEST(Stretch, IsThePartOfTheElements) {
  Mesh<2> mesh = rectangle({0, 0}, {4, 4}, {4, 4});
  for (auto& point : mesh.points)
    if (point[0] == 4) point[0] = 13;  // the last column of cells is ten times as long as the others
  EXPECT_DOUBLE_EQ(stretched_part(mesh, limit), 0.25);
}

}  // namespace
}  // namespace signorini
