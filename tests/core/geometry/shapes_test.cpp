#include "core/geometry/shapes.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/types.hpp"

namespace signorini {
namespace {

using Vector = std::vector<Field>;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string origin = "scene.toml:12: obstacle.0";

Distance at(const DistanceFunction& shape, const Point<3>& p, const Point<3>& n = {}) {
  Status status;
  const Distance d = shape.at(p.data(), n.data(), status);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_NEAR(std::hypot(d.normal[0], d.normal[1], d.normal[2]), 1, 1e-15);
  return d;
}

std::string failure(const DistanceFunction& shape, const Point<3>& p) {
  Status status;
  shape.at(p.data(), p.data(), status);
  EXPECT_EQ(status.code, static_cast<int>(Exit::input));
  return status.message;
}

template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

Field expression(double (*function)(const Site&), const char* text = "expression") {
  return Field(function, text, "scene.toml:14: obstacle.0.distance");
}

/// The normal is the gradient of the distance, by central differences.
void expect_gradient(const DistanceFunction& shape, const Point<3>& p) {
  constexpr double step = 1e-5;
  const Distance d = at(shape, p);
  for (int k = 0; k < 3; ++k) {
    Point<3> left = p, right = p;
    left[k] -= step;
    right[k] += step;
    EXPECT_NEAR(d.normal[k], (at(shape, right).value - at(shape, left).value) / (2 * step), 1e-9);
  }
}

TEST(Plane, HasTheDistanceAlongItsUnitNormal) {
  const auto plane = geometry::plane({0, 0, -1}, {0, 0, 5}, 1, origin);
  EXPECT_EQ(at(*plane, {3, 4, 1}).value, 2);
  EXPECT_EQ(at(*plane, {3, 4, -3}).value, -2);
  EXPECT_THAT(at(*plane, {3, 4, 1}).normal, ElementsAre(0, 0, 1));
  const auto tilted = geometry::plane({1, 2}, {3e-300, 4e-300}, 1, origin);  // 2D
  EXPECT_NEAR(at(*tilted, {2, 3, 0}).value, 7.0 / 5, 1e-15);
  expect_gradient(*geometry::plane({1, 2, 3}, {1, -2, 0.5}, 1, origin), {0.3, 0.2, 0.1});
}

TEST(Plane, MayMoveWithTheStep) {
  const auto plane = geometry::plane({0, expression([](const Site& s) { return -s.t; })}, {0, 1}, 0.25, origin);
  EXPECT_EQ(at(*plane, {0, 1, 0}).value, 1.25);
}

TEST(Plane, NeedsANormal) {
  EXPECT_THAT(error_of([] {
                geometry::plane({0, 0, 0}, {0, 0, 0}, 1, origin);
              }),
              testing::AllOf(HasSubstr(origin), HasSubstr("normal")));
  const auto turning = geometry::plane({0, 0}, {expression([](const Site& s) { return s.x[0]; }), 0}, 1, origin);
  EXPECT_THAT(at(*turning, {-2, 0, 0}).normal, ElementsAre(-1, 0, 0));
  EXPECT_THAT(failure(*turning, {0, 1, 0}), HasSubstr("normal"));
}

TEST(Sphere, HasTheDistanceToItsSurfaceFromBothSides) {
  const auto outside = geometry::sphere({1, 2, 3}, 2, false, 1, origin);
  const auto inside = geometry::sphere({1, 2, 3}, 2, true, 1, origin);
  for (const Point<3>& p : {Point<3>{4, 6, 3}, Point<3>{1.5, 2, 3}}) {
    const double r = std::hypot(p[0] - 1, p[1] - 2, p[2] - 3);
    EXPECT_NEAR(at(*outside, p).value, r - 2, 1e-15);
    EXPECT_NEAR(at(*inside, p).value, 2 - r, 1e-15);
    expect_gradient(*outside, p);
    expect_gradient(*inside, p);
  }
  EXPECT_THAT(at(*outside, {4, 2, 3}).normal, ElementsAre(1, 0, 0));
  EXPECT_THAT(at(*inside, {4, 2, 3}).normal, ElementsAre(-1, 0, 0));
}

TEST(Sphere, HasAUnitNormalInThePlaneAtItsCentre) {
  const auto disk = geometry::sphere({1, 2}, 2, false, 1, origin);
  EXPECT_EQ(at(*disk, {1, 2, 0}).value, -2);
  EXPECT_EQ(at(*disk, {1, 2, 0}).normal[2], 0);
}

TEST(Sphere, NeedsAPositiveRadius) {
  EXPECT_THAT(error_of([] { geometry::sphere({0, 0, 0}, -1, false, 1, origin); }), HasSubstr("radius"));
  const auto shrinking =
      geometry::sphere({0, 0, 0}, expression([](const Site& s) { return s.x[2]; }), false, 1, origin);
  EXPECT_THAT(failure(*shrinking, {0, 1, -1}), HasSubstr("radius"));
}

TEST(Cylinder, HasTheDistanceToItsAxisLessTheRadius) {
  const auto cylinder = geometry::cylinder({1, 0, 0}, {0, 7, 0}, 0.5, false, 1, origin);
  EXPECT_NEAR(at(*cylinder, {4, 99, 4}).value, 4.5, 1e-14);
  EXPECT_NEAR(at(*geometry::cylinder({1, 0, 0}, {0, 7, 0}, 0.5, true, 1, origin), {4, 99, 4}).value, -4.5, 1e-14);
  expect_gradient(*geometry::cylinder({1, 2, 3}, {1, 1, 2}, 0.5, false, 1, origin), {0.3, 0.2, 0.1});
  const Distance axis = at(*cylinder, {1, 5, 0});
  EXPECT_EQ(axis.value, -0.5);
  EXPECT_EQ(axis.normal[1], 0);
}

TEST(Cylinder, NeedsAnAxisAndAPositiveRadius) {
  EXPECT_THAT(error_of([] { geometry::cylinder({0, 0, 0}, {0, 0, 0}, 1, false, 1, origin); }), HasSubstr("axis"));
  EXPECT_THAT(error_of([] { geometry::cylinder({0, 0, 0}, {0, 0, 1}, 0, false, 1, origin); }), HasSubstr("radius"));
}

TEST(Expression, HasTheGradientForANormal) {
  const Field distance = expression([](const Site& s) { return std::hypot(s.x[0], s.x[1], s.x[2]) - 1; });
  const Distance d = at(*geometry::expression(distance, {}, 3, 1, origin), {0.6, 0, -1.2});
  EXPECT_NEAR(d.value, 0.6 * std::sqrt(5) - 1, 1e-15);
  EXPECT_NEAR(d.normal[0], 1 / std::sqrt(5), 1e-10);
  EXPECT_NEAR(d.normal[1], 0, 1e-10);
  EXPECT_NEAR(d.normal[2], -2 / std::sqrt(5), 1e-10);
}

TEST(Expression, HasNoThirdDirectionInThePlane) {
  const Field distance = expression([](const Site& s) { return s.x[1] + 100 * s.x[2]; });
  EXPECT_THAT(at(*geometry::expression(distance, {}, 2, 1, origin), {1, 2, 0}).normal,
              ElementsAre(0, testing::DoubleNear(1, 1e-15), 0));
}

TEST(Expression, TakesAGivenNormalThatSeesPositionAndBody) {
  const Field distance = expression([](const Site& s) { return s.x[0]; });
  const Field other = expression([](const Site& s) { return -2 * s.n[1]; });
  EXPECT_THAT(at(*geometry::expression(distance, {0, other}, 2, 1, origin), {1, 2, 0}, {0, 1, 0}).normal,
              ElementsAre(0, -1, 0));
}

TEST(Expression, FailsWhereItHasNoValueOrNoGradient) {
  const Field root = expression([](const Site& s) { return std::sqrt(s.x[0]); }, "sqrt(x)");
  const auto shape = geometry::expression(root, {}, 3, 1, origin);
  EXPECT_THAT(failure(*shape, {-1, 0, 0}), testing::AllOf(HasSubstr("sqrt(x)"), HasSubstr("scene.toml:14")));
  const auto flat = geometry::expression(Field(1.0), {}, 3, 1, origin);
  EXPECT_THAT(failure(*flat, {-1, 0, 0}), HasSubstr("gradient"));
  EXPECT_THAT(error_of([] { geometry::expression(Field(1.0), {0, 0, 0}, 3, 1, origin); }), HasSubstr("normal"));
}

Distance expressed(double (*function)(const Site&), const Point<3>& p, int dimension) {
  return at(*geometry::expression(expression(function), {}, dimension, 1, origin), p);
}

void expect_distance(const Distance& found, double value, const Point<3>& normal, double relative = 1e-9) {
  EXPECT_NEAR(found.value, value, relative * std::abs(value));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found.normal[k], normal[k], 1e-7);
}

TEST(Expression, NeedBeNoDistance) {
  expect_distance(expressed([](const Site& s) { return 2 * (s.x[1] + 0.01); }, {0.3, 0, 0}, 2), 0.01, {0, 1, 0});
  const auto circle = [](const Site& s) { return s.x[0] * s.x[0] + s.x[1] * s.x[1] - 1; };
  expect_distance(expressed(circle, {3, 4, 0}, 2), 4, {0.6, 0.8, 0});
  expect_distance(expressed(circle, {0.06, 0.08, 0}, 2), -0.9, {0.6, 0.8, 0});
  const auto around = [](const Site& s) { return 1 - s.x[0] * s.x[0] - s.x[1] * s.x[1]; };
  expect_distance(expressed(around, {0.06, 0.08, 0}, 2), 0.9, {-0.6, -0.8, 0});
  // 1/2 (1 + 3 / 2) is where the normal of x^2 at (1/2, 1/4) goes through y = 1.25 at x = -1/2
  expect_distance(expressed([](const Site& s) { return s.x[0] * s.x[0] - s.x[1]; }, {1, -0.25, 0}, 2), std::sqrt(0.5),
                  {std::sqrt(0.5), -std::sqrt(0.5), 0});
  const auto ellipsoid = [](const Site& s) {
    return std::pow(s.x[0] / 3, 2) + std::pow(s.x[1] / 2, 2) + std::pow(s.x[2], 2) - 1;
  };
  const Point<3> foot{3 * 0.48, 2 * 0.64, 0.6};
  Point<3> n{foot[0] / 9, foot[1] / 4, foot[2]};
  const double length = std::hypot(n[0], n[1], n[2]);
  for (const double d : {-0.1, 0.0, 1e-6, 0.01, 1.0, 100.0}) {
    for (double& c : n) c /= d == -0.1 ? length : 1;
    expect_distance(expressed(ellipsoid, {foot[0] + d * n[0], foot[1] + d * n[1], foot[2] + d * n[2]}, 3), d, n, 1e-8);
  }
}

TEST(Expression, OfAnyUnitIsZeroAtTheSamePlace) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const Field body([unit](const Site& s) { return unit * (s.x[1] * s.x[1] + s.x[2] * s.x[2] - 0.25); }, "cylinder",
                     "scene.toml:14");
    expect_distance(at(*geometry::expression(body, {}, 3, 1, origin), {7, 0.4, 0.3}), 0, {0, 0.8, 0.6});
    expect_distance(at(*geometry::expression(body, {}, 3, 1, origin), {7, 0.8, 0.6}), 0.5, {0, 0.8, 0.6});
  }
}

TEST(Expression, MayHaveEdges) {
  const auto wedge = [](const Site& s) { return 3 * std::max(s.x[1] + s.x[0], s.x[1] - s.x[0]); };  // its tip is up
  expect_distance(expressed(wedge, {0, 2, 0}, 2), 2, {0, 1, 0});
  expect_distance(expressed(wedge, {0.6, 0.8, 0}, 2), 1, {0.6, 0.8, 0});
  expect_distance(expressed(wedge, {2, 0, 0}, 2), std::sqrt(2), {std::sqrt(0.5), std::sqrt(0.5), 0});
  expect_distance(expressed(wedge, {0, -1, 0}, 2), -std::sqrt(0.5), {std::sqrt(0.5), std::sqrt(0.5), 0});
  const auto cube = [](const Site& s) {
    return 2 * std::max({std::abs(s.x[0]), std::abs(s.x[1]), std::abs(s.x[2])}) - 2;
  };
  expect_distance(expressed(cube, {1.48, 1.64, 1.6}, 3), 1, {0.48, 0.64, 0.6});
  expect_distance(expressed(cube, {1.6, 1.8, 0.4}, 3), 1, {0.6, 0.8, 0});
  const auto lens = [](const Site& s) {
    return std::max(std::pow(s.x[0] - 0.6, 2), std::pow(s.x[0] + 0.6, 2)) + s.x[1] * s.x[1] - 1;
  };
  expect_distance(expressed(lens, {0.05, 1.8, 0}, 2), std::hypot(0.05, 1),
                  {0.05 / std::hypot(0.05, 1), 1 / std::hypot(0.05, 1), 0});
  const auto groove = [](const Site& s) { return std::min(s.x[1] + 2 * s.x[0], s.x[1] - 2 * s.x[0]); };
  EXPECT_NEAR(expressed(groove, {0, 2, 0}, 2).value, 2 / std::sqrt(5), 1e-9);
}

TEST(Expression, FailsWhereItIsNowhereZero) {
  const Field bowl = expression([](const Site& s) { return s.x[0] * s.x[0] + 1; }, "x^2 + 1");
  EXPECT_THAT(failure(*geometry::expression(bowl, {}, 2, 1, origin), {2, 3, 0}),
              testing::AllOf(HasSubstr("'x^2 + 1' at [2, 3, 0] is no distance"), HasSubstr("gradient has length 4,")));
}

TEST(Expression, IsMeasuredAlongTheNormalThatGoesWithIt) {
  const auto along = [](double (*function)(const Site&), const Vector& normal) {
    return at(*geometry::expression(expression(function), normal, 2, 1, origin), {0.5, 1, 0}).value;
  };
  EXPECT_EQ(along([](const Site& s) { return s.x[1] + 0.2 * s.x[0] * s.x[0]; }, {0, 1}), 1.05);
  EXPECT_EQ(along([](const Site& s) { return 0.2 * s.x[0] * s.x[0]; }, {0, 1}), 0.05);
  EXPECT_EQ(along([](const Site& s) { return s.x[0] < 0.501 ? s.x[1] : s.x[1] + 1; }, {0, 1}), 1);
  EXPECT_NEAR(along([](const Site& s) { return 7 * s.x[1]; }, {0, 2}), 1, 1e-14);
  EXPECT_NEAR(along([](const Site& s) { return s.x[0] * s.x[0] + s.x[1] * s.x[1] - 0.5; }, {0, 1}), 0.5, 1e-11);
  // Nearly on it all that is left is rounding of the larger terms.
  const auto circle = [](const Site& s) { return s.x[0] * s.x[0] + (s.x[1] + 20) * (s.x[1] + 20) - 400; };
  const auto drawn = geometry::expression(expression(circle), Vector{0, 1}, 2, 1, origin);
  for (const double height : {1e-9, 1e-7, 3e-7, 1e-5})
    EXPECT_NEAR(at(*drawn, {0.3, std::sqrt(400 - 0.09) - 20 + height, 0}).value, height, 1e-13) << height;
}

TEST(Shapes, RejectPointsThatAreNotFinite) {
  for (const auto& shape : {geometry::plane({0, 0, 0}, {0, 0, 1}, 1, origin).release(),
                            geometry::sphere({0, 0, 0}, 1, false, 1, origin).release()}) {
    failure(*shape, {0, std::nan(""), 0});
    failure(*shape, {0, 0, infinity});
    delete shape;
  }
}

}  // namespace
}  // namespace signorini
