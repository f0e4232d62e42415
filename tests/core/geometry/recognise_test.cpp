// Shapes recognised by points on them, and what is none of them.
#include "core/geometry/recognise.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <numbers>
#include <random>

#include "core/mesh/curve.hpp"

namespace signorini::geometry {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// Points and normals of a surface, turned and moved.
struct Cloud {
  std::vector<Point<3>> points, normals;

  Cloud(const std::function<std::pair<Vector3d, Vector3d>(double, double)>& surface, double noise = 0) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> number(0, 1);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    for (int i = 0; i < 60; ++i) {
      const auto [p, n] = surface(number(random), number(random));
      const Vector3d at = turn * (p + noise * (number(random) - 0.5) * n) + Vector3d(10, -4, 3), out = turn * n;
      points.push_back({at[0], at[1], at[2]});
      normals.push_back({out[0], out[1], out[2]});
    }
    axis = turn.col(2);
  }
  Vector3d axis;
};

std::pair<Vector3d, Vector3d> cylinder(double u, double v) {
  const Vector3d n(std::cos(2 * u), std::sin(2 * u), 0);
  return {0.7 * n + Vector3d(0, 0, 3 * v), n};
}
std::pair<Vector3d, Vector3d> cone(double u, double v) {
  const double r = 0.5 + v, a = 0.4;
  const Vector3d out(std::cos(3 * u), std::sin(3 * u), 0);
  return {r * out + Vector3d(0, 0, r / std::tan(a)), std::cos(a) * out - Vector3d(0, 0, std::sin(a))};
}
std::pair<Vector3d, Vector3d> sphere(double u, double v) {
  const double z = 0.9 * v;
  const Vector3d n(std::sqrt(1 - z * z) * std::cos(2 * pi * u), std::sqrt(1 - z * z) * std::sin(2 * pi * u), z);
  return {2 * n, n};
}
std::pair<Vector3d, Vector3d> torus(double u, double v) {
  const Vector3d out(std::cos(2 * u), std::sin(2 * u), 0);
  const Vector3d n = std::cos(2 * v) * out + std::sin(2 * v) * Vector3d::UnitZ();
  return {2 * out + 0.5 * n, n};
}
std::pair<Vector3d, Vector3d> saddle(double u, double v) {
  const double x = u - 0.5, y = v - 0.5;
  return {Vector3d(x, y, x * x - 0.5 * y * y + x * x * y), Vector3d(-2 * x - 2 * x * y, y - x * x, 1).normalized()};
}

std::optional<Recognised<3>> found(const Cloud& cloud, double tolerance = 1e-6) {
  return recognise<3>(cloud.points, cloud.normals, 1e-6, tolerance);
}

void expect_axis(const Cloud& cloud, const Curve<3>& curve) {
  EXPECT_NEAR(std::abs(cloud.axis.dot(Vector3d(curve.axis.data()))), 1, 1e-10);
}

TEST(Recognise, ShapesBySomePointsOnThem) {
  const auto a = found(Cloud(cylinder)), b = found(Cloud(cone)), c = found(Cloud(sphere)), d = found(Cloud(torus));
  ASSERT_TRUE(a && b && c && d);
  EXPECT_EQ(a->curve.kind, CurveKind::cylinder);
  EXPECT_NEAR(a->curve.radius, 0.7, 1e-9);
  expect_axis(Cloud(cylinder), a->curve);
  EXPECT_EQ(b->curve.kind, CurveKind::cone);
  EXPECT_NEAR(b->curve.second, 0.4, 1e-9);
  expect_axis(Cloud(cone), b->curve);
  EXPECT_EQ(c->curve.kind, CurveKind::round);
  EXPECT_NEAR(c->curve.radius, 2, 1e-9);
  EXPECT_EQ(d->curve.kind, CurveKind::torus);
  EXPECT_NEAR(d->curve.radius, 0.5, 1e-9);
  EXPECT_NEAR(d->curve.second, 2, 1e-9);
  expect_axis(Cloud(torus), d->curve);
  for (const auto& shape : {a, b, c, d}) EXPECT_LT(shape->deviation, 1e-9);
}

TEST(Recognise, NothingInASurfaceThatIsNoneOfThem) { EXPECT_FALSE(found(Cloud(saddle))); }

TEST(Recognise, WithinATolerance) {
  EXPECT_FALSE(found(Cloud(cylinder, 1e-3)));
  const auto near = found(Cloud(cylinder, 1e-3), 1e-2);
  ASSERT_TRUE(near);
  EXPECT_EQ(near->curve.kind, CurveKind::cylinder);
  EXPECT_NEAR(near->curve.radius, 0.7, 1e-3);
  EXPECT_GT(near->deviation, 1e-4);
  EXPECT_LT(near->deviation, 1e-3);
}

TEST(Recognise, ACircleByFourPointsNotByThree) {
  std::vector<Point<2>> points, normals;
  for (const double a : {0.1, 0.4, 0.9, 1.3}) {
    points.push_back({3 + 2 * std::cos(a), 2 * std::sin(a) - 1});
    normals.push_back({std::cos(a), std::sin(a)});
  }
  const auto circle = recognise<2>(points, normals, 1e-6, 1e-6);
  ASSERT_TRUE(circle);
  EXPECT_NEAR(circle->curve.radius, 2, 1e-10);
  EXPECT_NEAR(circle->curve.center[0], 3, 1e-10);
  points.pop_back();
  normals.pop_back();
  EXPECT_FALSE(recognise<2>(points, normals, 1e-6, 1e-6));
}

TEST(Curves, DistancesAreThoseToTheNearestPoint) {
  const double third = 1 / std::sqrt(3);
  const Point<3> axis{third, third, third};
  for (const Curve<3>& curve :
       {Curve<3>{.center = {1, 0, 2}, .radius = 0.5},
        Curve<3>{.center = {1, 0, 2}, .radius = 0.5, .kind = CurveKind::cylinder, .axis = axis},
        Curve<3>{.center = {1, 0, 2}, .kind = CurveKind::cone, .axis = axis, .second = 0.5},
        Curve<3>{.center = {1, 0, 2}, .radius = 0.3, .kind = CurveKind::torus, .axis = axis, .second = 1.5}}) {
    const Point<3> p{2.5, 1.1, 2.9};
    const auto here = height<3>(curve, p);
    ASSERT_TRUE(here);
    const Point<3> q = project<3>(curve, p);
    EXPECT_NEAR(height<3>(curve, q)->distance, 0, 1e-14);
    for (int k = 0; k < 3; ++k) {
      Point<3> a = p, b = p;
      a[k] += 1e-6;
      b[k] -= 1e-6;
      EXPECT_NEAR((height<3>(curve, a)->distance - height<3>(curve, b)->distance) / 2e-6, here->normal[k], 1e-8);
      EXPECT_NEAR(p[k] - q[k], here->distance * here->normal[k], 1e-14);
    }
  }
}

}  // namespace
}  // namespace signorini::geometry
