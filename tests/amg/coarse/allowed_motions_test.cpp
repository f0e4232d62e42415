// Motions that no bound ends: those of a body in the plane between walls.
#include "amg/coarse/allowed_motions.hpp"

#include <gtest/gtest.h>

#include "core/base/types.hpp"

namespace signorini::test {
namespace {

const Eigen::RowVector2d x(2, 0), y(0, 3);  // rows of any length

TEST(AllowedMotions, AreAllWithoutBounds) {
  AllowedMotions allowed(2);
  allowed.bound(x, -infinity, infinity);
  EXPECT_TRUE(allowed.all());
  const Eigen::Vector2d work(1, -2);
  EXPECT_EQ(allowed.nearest(work), work);
  EXPECT_EQ(allowed.least_rate(work), infinity);
}

TEST(AllowedMotions, EndAtBoundsOfTheirSide) {
  AllowedMotions floor(2), walls(2);
  floor.bound(y, 0, infinity);
  walls.bound(x, -1, 1);
  EXPECT_LE((floor.nearest(Eigen::Vector2d(1, -2)) - Eigen::Vector2d(1, 0)).norm(), 1e-14);
  EXPECT_LE((floor.nearest(Eigen::Vector2d(1, 2)) - Eigen::Vector2d(1, 2)).norm(), 1e-14);
  EXPECT_LE((walls.nearest(Eigen::Vector2d(1, 2)) - Eigen::Vector2d(0, 2)).norm(), 1e-14);
  EXPECT_DOUBLE_EQ(floor.least_rate(Eigen::Vector2d(5, -2)), -2);
  EXPECT_DOUBLE_EQ(floor.least_rate(Eigen::Vector2d(5, 2)), 2);
}

TEST(AllowedMotions, RowsOfMatricesStoredByColumnsWillDo) {
  Eigen::MatrixXd rows(2, 2);
  rows << 0, 7, 1, 1;
  AllowedMotions allowed(2);
  allowed.bound(rows.row(0), -infinity, 4);
  EXPECT_LE((allowed.nearest(Eigen::Vector2d(3, 4)) - Eigen::Vector2d(3, 0)).norm(), 1e-14);
}

}  // namespace
}  // namespace signorini::test
