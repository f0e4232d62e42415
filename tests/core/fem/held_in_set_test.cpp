// Values prescribed where a scalar obstacle touches: the contact reaches as far as the boundary.
#include "core/fem/recovery/held_in_set.hpp"

#include <gtest/gtest.h>

#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

ContactSummary<1> contact(Index cells, const std::optional<std::string>& on, const std::vector<Fix<1>>& fixes,
                          double source) {
  const Mesh<2> mesh = distorted_mesh<2>(cells);
  Model<1> model;
  model.fixes = fixes;
  model.loads.push_back({on ? std::optional(Selection{on, {}, ""}) : std::nullopt, {source}});
  model.obstacles = {term<1>([](const SurfaceVertex&) { return bound<1>({1}, 0, infinity); }, on)};
  const auto discrete = discretize(mesh, model);
  return contact_state(mesh, model, discrete, solve_bounded(discrete.problem)).obstacles[0];
}

// All of the body rests on the obstacle, and the boundary is held there: u = 0.
TEST(HeldInSet, AllOfABodyRests) {
  const auto found = contact(6, {}, {fix<1>("boundary", {0})}, -2);
  EXPECT_NEAR(found.area, 1, 1e-12);
  EXPECT_NEAR(found.force[0], 2, 1e-11);
}

// u'' = 1, u(0) = 1/8, u(1) = 0 on u >= 0: contact for x > 1/2, up to the held end.
TEST(HeldInSet, ContactReachesAHeldEnd) {
  for (const Index cells : {10, 20}) {
    const auto found = contact(cells, {}, {fix<1>("left", {0.125}), fix<1>("right", {0})}, -1);
    EXPECT_NEAR(found.area, 0.5, 0.4 / (cells * cells));
    EXPECT_NEAR(found.force[0], 0.5, 0.4 / (cells * cells));
  }
}

// The pressure rises at once from a held end that touches: nothing rests there.
TEST(HeldInSet, WhatTouchesAtTheEndAloneDoesNotRest) {
  const auto found = contact(6, {}, {fix<1>("left", {0}), fix<1>("right", {0})}, 1);
  EXPECT_EQ(found.nodes, 0);
  EXPECT_EQ(found.area, 0);
  EXPECT_EQ(found.force[0], 0);
}

// An obstacle at the bottom that a flux leaves through, all of it in contact, between held sides.
TEST(HeldInSet, FacesBetweenHeldSides) {
  const auto found = contact(6, "bottom", {fix<1>("left", {0}), fix<1>("right", {0})}, -2);
  EXPECT_NEAR(found.area, 1, 1e-12);
  EXPECT_NEAR(found.force[0], 2, 1e-11);
}

}  // namespace
}  // namespace signorini::testing
