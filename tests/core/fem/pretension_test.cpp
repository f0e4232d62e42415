#include "core/fem/pairs/pretension.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sdk/block.hpp"

// The carrier of a bolt's cut: what is prescribed of its unknown.

namespace signorini {
namespace {

PretensionedTie<3> tie() { return {2, 5, {0.6, 0, 0.8}}; }

/// The mean square of what a vector has along prescribed directions.
double prescribed_part(const FixedDirections<3>& fixed, const double* v) {
  double sum = 0;
  for (int k = 0; k < fixed.count; ++k) sum += std::pow(block::dot<3>(fixed.direction[k], v), 2);
  return sum;
}

TEST(Carrier, IsFreeAlongTheCutsNormalAlone) {
  const double normal[] = {0.6, 0, 0.8}, across[] = {0.8, 0, -0.6}, along[] = {0, 1, 0};
  FixedDirections<3> fixed{.vertex = 5};
  fixed.add(along, 0.25, 7);  // a fix
  hold_carrier<3>(tie(), {.force = 1, .locked = {}, .origin = {}}, fixed);
  ASSERT_EQ(fixed.count, 2);
  EXPECT_NEAR(prescribed_part(fixed, normal), 0, 1e-15);
  EXPECT_NEAR(prescribed_part(fixed, across), 1, 1e-15);
  EXPECT_EQ(fixed.fix[0], 7);
  EXPECT_EQ(fixed.value[0], 0.25);
  EXPECT_EQ(fixed.fix[1], by_tie(2));
  EXPECT_NEAR(fixed.value[1], 0, 1e-15);
}

TEST(Carrier, HasItsLengthWhereItIsLocked) {
  FixedDirections<3> fixed{.vertex = 5};
  hold_carrier<3>(tie(), {.force = 1, .locked = 0.125, .origin = {}}, fixed);
  ASSERT_EQ(fixed.count, 3);
  double v[3] = {};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) v[i] += fixed.value[k] * fixed.direction[k][i];
  EXPECT_NEAR(v[0], 0.6 * 0.125, 1e-15);
  EXPECT_NEAR(v[1], 0, 1e-15);
  EXPECT_NEAR(v[2], 0.8 * 0.125, 1e-15);
}

TEST(Carrier, BearsItsShareOfTheForceUntilThen) {
  Model<3> model;
  model.obstacles.resize(3);
  model.obstacles[2].pretension = Pretension{.force = 8, .locked = {}, .origin = {}};
  PretensionedTie<3> quarter = tie();
  quarter.copies = 4;
  EXPECT_EQ(pull<3>(quarter, model), 2);
  model.obstacles[2].pretension->locked = 0.1;
  EXPECT_EQ(pull<3>(quarter, model), 0);
}

}  // namespace
}  // namespace signorini
