// Obstacles by the C interface: tables with friction, and energies by functions of the caller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "c/signorini.h"

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double stiffness = 2, none = std::numeric_limits<double>::infinity();

/// Unknowns that nothing couples.
class Springs {
 public:
  Springs(int unknowns, int block) : x(static_cast<std::size_t>(unknowns)), force(x) {
    std::vector<int32_t> row{0}, column;
    for (int32_t i = 0; i < unknowns; ++i) {
      column.push_back(i);
      row.push_back(i + 1);
    }
    const std::vector<double> value(x.size(), stiffness);
    EXPECT_EQ(signorini_create(unknowns, row.data(), column.data(), value.data(), block, &solver_), SIGNORINI_SOLVED);
  }
  ~Springs() { signorini_destroy(solver_); }

  int set(const signorini_obstacle& obstacle) {
    const signorini_obstacle* one = &obstacle;
    return signorini_set_obstacles(solver_, 1, &one);
  }
  int solve(const std::vector<double>& b) {
    return signorini_solve(solver_, b.data(), nullptr, nullptr, nullptr, 1e-13, x.data(), force.data(), nullptr);
  }
  signorini_solver* get() const { return solver_; }

  std::vector<double> x, force;

 private:
  signorini_solver* solver_ = nullptr;
};

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-11) << i;
}

struct RoughFloor {
  const int32_t block[1] = {1};
  const double normal[2] = {0, 1}, gap[1] = {-0.1}, friction[1] = {0.5};
  signorini_obstacle obstacle = SIGNORINI_OBSTACLE;

  RoughFloor() {
    obstacle.name = "floor";
    obstacle.blocks = 1;
    obstacle.block = block;
    obstacle.direction = normal;
    obstacle.lower = gap;
    obstacle.friction = friction;
  }
};

// The floor takes 3 - 0.1 * 2 of the load, and half of that along it.
TEST(CObstacles, FrictionSlipsAndCountsFromTheLastStep) {
  Springs springs(4, 2);
  const RoughFloor floor;
  ASSERT_EQ(springs.set(floor.obstacle), SIGNORINI_SOLVED) << signorini_message();
  EXPECT_EQ(signorini_next_step(springs.get()), SIGNORINI_BAD_INPUT);
  ASSERT_EQ(springs.solve({0, 0, 2, -3}), SIGNORINI_SOLVED) << signorini_message();
  expect_near(springs.x, {0, 0, 0.3, -0.1});
  expect_near(springs.force, {0, 0, -1.4, 2.8});
  std::vector<signed char> touching(2);
  ASSERT_EQ(signorini_touching(springs.get(), touching.data()), SIGNORINI_SOLVED);
  EXPECT_THAT(touching, ElementsAre(0, 1));
  ASSERT_EQ(signorini_next_step(springs.get()), SIGNORINI_SOLVED);
  ASSERT_EQ(springs.solve({0, 0, 0, -3}), SIGNORINI_SOLVED);
  expect_near(springs.x, {0, 0, 0.3, -0.1});
  ASSERT_EQ(signorini_set_obstacles(springs.get(), 0, nullptr), SIGNORINI_SOLVED);
  ASSERT_EQ(springs.solve({0, 0, 0, -3}), SIGNORINI_SOLVED);
  expect_near(springs.x, {0, 0, 0, -1.5});
}

/// phi(v) = g |v|, g the first number: a threshold.
namespace threshold {

double change(const signorini_slot* slot, const double* from, const double* to, void*) {
  const double sum = std::abs(*to) + std::abs(*from);
  return sum > 0 ? slot->number[0] * ((*to - *from) * (*to + *from) / sum) : 0;
}
double slope(const signorini_slot* slot, const double* at, const double* step, void*) {
  return slot->number[0] * (*at == 0 ? std::abs(*step) : std::copysign(*step, *at * *step));
}
void minimise(const signorini_slot* slot, const double* M, const double* r, const double* x, double* y, void* calls) {
  ++*static_cast<int*>(calls);
  const double pull = *r + *M * *x, g = slot->number[0];
  const double free = pull > g ? (pull - g) / *M : pull < -g ? (pull + g) / *M : 0;
  *y = std::min(std::max(free, *slot->lower), *slot->upper);
}
void linearise(const signorini_slot* slot, const double* x, double* gradient, double*, unsigned* critical, void*) {
  if (*x == 0)
    *critical |= 1u;
  else
    *gradient = std::copysign(slot->number[0], *x);
}

}  // namespace threshold

TEST(CObstacles, EnergiesOfTheCallerActPerBlock) {
  int calls = 0;
  signorini_energy energy = SIGNORINI_ENERGY;
  energy.change = threshold::change;
  energy.slope = threshold::slope;
  energy.minimise = threshold::minimise;
  energy.linearise = threshold::linearise;
  energy.data = &calls;
  const int32_t block[] = {0, 1, 2};
  const double number[] = {1, 2, 1}, upper[] = {none, none, 0.5};
  signorini_obstacle obstacle = SIGNORINI_OBSTACLE;
  obstacle.blocks = 3;
  obstacle.block = block;
  obstacle.upper = upper;
  obstacle.energy = &energy;
  obstacle.numbers = 1;
  obstacle.number = number;
  Springs springs(4, 1);
  ASSERT_EQ(springs.set(obstacle), SIGNORINI_SOLVED) << signorini_message();
  ASSERT_EQ(springs.solve({-3, 1.5, 9, 4}), SIGNORINI_SOLVED) << signorini_message();
  expect_near(springs.x, {-1, 0, 0.5, 2});
  expect_near(springs.force, {1, -1.5, -8, 0});
  EXPECT_GT(calls, 0);
}

TEST(CObstacles, WrongOnesAreRefusedByName) {
  Springs springs(4, 2);
  const auto refused = [&](auto&& change, const char* message) {
    RoughFloor floor;
    change(floor.obstacle);
    EXPECT_EQ(springs.set(floor.obstacle), SIGNORINI_BAD_INPUT);
    EXPECT_THAT(signorini_message(), HasSubstr(message));
  };
  const double nan[] = {std::numeric_limits<double>::quiet_NaN(), 1}, negative[] = {-1}, twice[] = {0, 2};
  const int32_t far[] = {2};
  const signorini_energy energy = SIGNORINI_ENERGY;
  refused([](auto& o) { o.size = 0; }, "obstacle.size: found 0, expected sizeof(signorini_obstacle)");
  refused([](auto& o) { o.block = nullptr; }, "floor: 'block' is null, expected an array");
  refused([](auto& o) { o.directions = 3; }, "floor: found 3 directions, expected 1 to 2, the block size");
  refused([&](auto& o) { o.block = far; }, "floor: found block 2, expected 0 to 1");
  refused([&](auto& o) { o.friction = negative; }, "floor: block 1: found the friction -1, expected a finite number");
  refused([&](auto& o) { o.lower = nan; },
          "floor: at block 1 the plugin gives direction 0 a bound that is not a number");
  refused([&](auto& o) { o.direction = twice; }, "floor: at block 1 the plugin gives direction 0 of length 2");
  refused([&](auto& o) { o.energy = &energy; }, "floor: found friction and an energy, expected one of them");
  refused([&](auto& o) { o.friction = nullptr, o.energy = &energy; }, "floor: its energy has a null among 'change'");
  Springs scalar(2, 1);
  EXPECT_EQ(scalar.set(RoughFloor().obstacle), SIGNORINI_BAD_INPUT);
  EXPECT_THAT(signorini_message(), HasSubstr("floor: found friction with blocks of 1"));
}

}  // namespace
