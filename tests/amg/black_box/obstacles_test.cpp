// Obstacles at blocks of a matrix: closed forms at single blocks, and what is said of wrong input. (Whole bodies are in
// obstacles_on_meshes_test.cpp.)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "amg/black_box.hpp"
#include "amg/obstacle_by_name.hpp"
#include "amg/tabulated_obstacle.hpp"
#include "core/base/error.hpp"
#include "core/sdk/box_obstacle.hpp"
#include "core/sdk/coulomb_law.hpp"

namespace signorini::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Matrix = Eigen::SparseMatrix<double>;

constexpr double stiffness = 2;

Matrix springs(int unknowns) {
  Matrix A(unknowns, unknowns);
  A.setIdentity();
  return stiffness * A;
}

std::vector<SurfaceVertex> places(std::size_t count) { return {count, SurfaceVertex{{}, {}, 1}}; }

template <int B>
BlockObstacle<B> bounds(std::vector<Index> blocks, std::vector<double> direction, std::vector<double> lower,
                        std::string name = "wall") {
  const int directions = static_cast<int>(lower.size() / blocks.size());
  ObstacleTable<B> table{blocks, directions, std::move(direction), std::move(lower), {}, 0, {}};
  const std::size_t count = blocks.size();
  return {std::make_shared<const TabulatedObstacle<B, BoxObstacle<B>>>(std::move(table)), std::move(blocks),
          places(count), std::move(name)};
}

/// Friction 0.5 at block 1, against a plane with this normal a distance 0.1 away.
template <int B>
BlockObstacle<B> rough(std::vector<double> normal) {
  ObstacleTable<B> table{{1}, 1, std::move(normal), {-0.1}, {}, 2, {0, 0.5}};
  return {std::make_shared<const TabulatedObstacle<B, CoulombLaw<B>>>(std::move(table)), {1}, places(1), "floor"};
}

SolverOptions accurate() {
  SolverOptions options;
  options.tolerance = 1e-13;
  return options;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-11) << i;
}

// The floor takes 3 - 0.1 * 2 of the load across it, and half of that along it.
TEST(BlackBoxObstacles, FrictionHoldsAndSlips) {
  for (const double angle : {0.0, 0.7}) {  // the block's frame is turned
    const double c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](double along, double across) {
      return std::vector<double>{0, 0, c * along - s * across, s * along + c * across};
    };
    BlackBox solver(springs(4), 2, accurate());
    solver.set_obstacles<2>({rough<2>({-s, c})});
    for (const double along : {1.0, 2.0}) {
      const auto result = solver.solve(turned(along, -3));
      ASSERT_TRUE(result.summary.converged()) << result.summary.reason;
      const double force = 2.8, slip = std::max(0.0, along - 0.5 * force) / stiffness;
      expect_near(result.x, turned(slip, -0.1));
      expect_near(result.multiplier, turned(stiffness * slip - along, force));
      EXPECT_THAT(result.touching, ElementsAre(1));
    }
    EXPECT_THAT(solver.solve(turned(1, 3)).touching, ElementsAre());
  }
}

TEST(BlackBoxObstacles, FrictionInSpaceIsAlongTheLoad) {
  BlackBox solver(springs(6), 3, accurate());
  solver.set_obstacles<3>({rough<3>({0, 0, 1})});
  const auto result = solver.solve(std::vector<double>{0, 0, 0, 3, 4, -3});
  const double slip = (5 - 1.4) / stiffness;
  expect_near(result.x, {0, 0, 0, 0.6 * slip, 0.8 * slip, -0.1});
}

// It slipped by 0.3 in the first step, and sticks there in the second one.
TEST(BlackBoxObstacles, FrictionCountsFromTheLastStep) {
  BlackBox solver(springs(4), 2, accurate());
  solver.set_obstacles<2>({rough<2>({0, 1})});
  EXPECT_THROW(solver.next_step(), Error);
  expect_near(solver.solve(std::vector<double>{0, 0, 2, -3}).x, {0, 0, 0.3, -0.1});
  expect_near(solver.solve(std::vector<double>{0, 0, 0, -3}).x, {0, 0, 0, -0.1});
  solver.solve(std::vector<double>{0, 0, 2, -3});
  solver.next_step();
  expect_near(solver.solve(std::vector<double>{0, 0, 0, -3}).x, {0, 0, 0.3, -0.1});
  solver.set_obstacles<2>({rough<2>({0, 1})});
  expect_near(solver.solve(std::vector<double>{0, 0, 0, -3}).x, {0, 0, 0, -0.1});
}

// Three planes around a corner, which has two coordinates: one of them is a face.
TEST(BlackBoxObstacles, ManyAtABlockMakeAPolyhedron) {
  const double d = std::sqrt(0.5);
  BlackBox solver(springs(2), 2, accurate());
  solver.set_obstacles<2>({bounds<2>({0}, {1, 0}, {-1}), bounds<2>({0}, {0, 1}, {-1}), bounds<2>({0}, {d, d}, {-d})});
  expect_near(solver.solve(std::vector<double>{-100, -100}).x, {-0.5, -0.5});
  expect_near(solver.solve(std::vector<double>{-100, 0}).x, {-1, 0});
  const auto result = solver.solve(std::vector<double>{-100, -90});
  expect_near(result.x, {-1, 0});
  expect_near(result.multiplier, {98, 90});
}

// As by bounds of unknowns.
TEST(BlackBoxObstacles, BoundsOfUnknownsHoldBesideThem) {
  BlackBox solver(springs(4), 2, accurate());
  solver.set_obstacles<2>({bounds<2>({0, 1}, {}, {-0.1, -0.2})});
  const std::vector<double> b{-9, -9, -9, 9}, lower{-infinity, -0.3, -0.15, 0.7},
      upper{infinity, infinity, infinity, 0.7};
  const auto result = solver.solve(b, lower, upper);
  expect_near(result.x, {-0.1, -0.3, -0.15, 0.7});
  expect_near(result.multiplier, {8.8, 8.4, 8.7, -7.6});
  EXPECT_THAT(result.touching, ElementsAre(0));
  EXPECT_THAT(result.active, ElementsAre(0, -1, -1, 1));
  solver.set_obstacles<2>({});
  expect_near(solver.solve(b, lower, upper).x, {-4.5, -0.3, -0.15, 0.7});
}

// What is prescribed across the obstacle's direction holds, in another frame.
TEST(BlackBoxObstacles, PrescribedUnknownsAreNoDirectionsOfTheirs) {
  BlackBox solver(springs(2), 2, accurate());
  solver.set_obstacles<2>({bounds<2>({0}, {0.6, 0.8}, {-1})});
  const std::vector<double> lower{0.5, -infinity}, upper{0.5, infinity};
  expect_near(solver.solve(std::vector<double>{0, -100}, lower, upper).x, {0.5, -1.3 / 0.8});
  expect_near(solver.solve(std::vector<double>{0, -1}, lower, upper).x, {0.5, -0.5});
}

TEST(BlackBoxObstacles, ServeAnotherMatrix) {
  BlackBox solver(springs(4), 2, accurate());
  solver.set_obstacles<2>({rough<2>({0.6, 0.8})});
  const std::vector<double> b{0, 0, 0.6 * -3, 0.8 * -3};
  expect_near(solver.solve(b).multiplier, {0, 0, 0.6 * 2.8, 0.8 * 2.8});
  solver.set_matrix(2 * springs(4));
  expect_near(solver.solve(b).multiplier, {0, 0, 0.6 * 2.6, 0.8 * 2.6});
}

/// A distance that is the same everywhere.
struct Floor final : DistanceFunction {
  Distance at(const double*, const double*, Status&) const noexcept override { return {0.1, {0, 1, 0}}; }
};

TEST(BlackBoxObstacles, OfPlugins) {
  BlackBox solver(springs(4), 2, accurate());
  const auto floor = std::make_shared<const Floor>();
  solver.set_obstacles<2>(
      {{obstacle_by_name<2>("coulomb", {"friction = 0.25 + 0.25*x"}, floor), {1}, {{{1}, {}, 1}}, "floor"}});
  expect_near(solver.solve(std::vector<double>{0, 0, 2, -3}).x, {0, 0, 0.3, -0.1});
}

template <class Action>
void expect_error(const Action& action, const std::string& message, Exit status = Exit::input) {
  try {
    action();
    ADD_FAILURE() << "accepted: " << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status);
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
}

TEST(BlackBoxObstacles, WrongPlacesNameTheBlock) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  BlackBox solver(springs(8), 2);
  const auto refused = [&](BlockObstacle<2> obstacle, const char* message, Exit status = Exit::input) {
    expect_error([&] { solver.set_obstacles<2>({std::move(obstacle)}); }, message, status);
  };
  const auto changed = [](auto&& change) {
    BlockObstacle<2> out = bounds<2>({1, 3}, {0, 1, 0, 1}, {-1, -1});
    change(out);
    return out;
  };
  refused(changed([](auto& o) { o.obstacle = nullptr; }), "wall: is null, expected an obstacle");
  refused(changed([](auto& o) { o.places.pop_back(); }), "wall: found 1 places, expected 2, one per block");
  refused(changed([](auto& o) { o.blocks[1] = 4; }), "wall: found block 4, expected 0 to 3");
  refused(changed([](auto& o) { o.blocks[1] = 1; }), "wall: found block 1 after block 1, expected ascending numbers");
  refused(changed([](auto& o) { o.places[1].position[0] = nan; }), "wall: block 3: found nan in its position");
  refused(changed([](auto& o) { o.places[1].normal[0] = 2; }), "wall: block 3: found a normal of length 2");
  BlockObstacle<2> no_measure = rough<2>({0, 1});
  no_measure.places[0].measure = 0;
  refused(no_measure, "floor: block 1: found the measure 0, expected a positive one");
  refused(bounds<2>({1, 3}, {0, 1, 0, 2}, {-1, -1}), "wall: at block 3 the plugin gives direction 0 of length 2",
          Exit::plugin);
  refused(bounds<2>({1, 3}, {0, 1, 0, 1}, {-1, nan}),
          "wall: at block 3 the plugin gives direction 0 a bound that is not", Exit::plugin);
  expect_error([&] { solver.set_obstacles<3>({bounds<3>({0}, {}, {-1})}); },
               "obstacles: given for blocks of 3, expected blocks of 2, as the matrix has");
  expect_error([&] { bounds<2>({1, 3}, {0, 1, 0}, {-1, -1}); }, "found 3 entries of directions, expected none or 4");
  solver.set_obstacles<2>({bounds<2>({0}, {0, 1}, {1}), bounds<2>({0}, {0, -1}, {1}, "ceiling")});
  expect_error([&] { solver.solve(std::vector<double>(8, 0.0)); }, "no solution at block 0: lower bound",
               Exit::no_solution);
}

/// Fails where it is asked for block 3.
class Broken final : public BoxObstacle<2> {
 public:
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", 2, 1}}}; }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<2>*,
                Status& status) const noexcept override {
    for (std::size_t i = 0; i < count; ++i)
      if (vertices[i].vertex == 3) status.fail(2, "no normal");
  }
};

TEST(BlackBoxObstacles, ComplaintsOfObstaclesNameTheBlock) {
  BlackBox solver(springs(8), 2);
  expect_error(
      [&] {
        solver.set_obstacles<2>({{std::make_shared<Broken>(), {1, 3}, places(2), "thing"}});
      },
      "thing: block 3: no normal");
  expect_error([&] { (void)obstacle_by_name<2>("coulomb", {"frictoin=1"}, std::make_shared<Floor>()); },
               "obstacle 'coulomb' has no option 'frictoin', did you mean 'friction'?");
  expect_error([&] { (void)obstacle_by_name<2>("coulomb", {"friction=1"}); }, "needs a 'shape'");
  expect_error([&] { (void)obstacle_by_name<1>("coulomb", {"friction=1"}); }, "knows no blocks of 1 unknowns");
}

/// A functional whose local solver stays where it is.
struct Idle {
  static double change(const Slot<1>&, const double* from, const double* to) {
    return 0.5 * (*to - *from) * (*to + *from);
  }
  static double slope(const Slot<1>&, const double* at, const double* step) { return *at * *step; }
  static void minimise(const Slot<1>&, const double*, const double*, const double* x, double* y) { *y = *x; }
  static void linearise(const Slot<1>&, const double* x, const QuadraticModel<1>& out) {
    *out.gradient = *x;
    *out.hessian = 1;
  }
};

TEST(BlackBoxObstacles, WrongFunctionalsAreNoticed) {
  BlackBox solver(springs(2), 1);
  ObstacleTable<1> table{{1}, 1, {}, {-1}, {}, 0, {}};
  using Wrong = TabulatedObstacle<1, FunctionalObstacle<1, Idle>>;
  solver.set_obstacles<1>({{std::make_shared<const Wrong>(std::move(table)), {1}, places(1), "foundation"}});
  expect_error([&] { solver.solve(std::vector<double>{1, 1}); }, "foundation: at block 1", Exit::plugin);
}

}  // namespace
}  // namespace signorini::test
