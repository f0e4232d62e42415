#include <gmock/gmock.h>

#include <numbers>
#include <numeric>
#include <random>
#include <thread>

#include "geometry_checks.hpp"
#include "surfaces.hpp"

namespace signorini {
namespace {

using geometry::engine;
using test::cube;
using test::Surface;
using test::TemporaryFile;

Distance at(const DistanceFunction& surface, const Point<3>& p) {
  Status status;
  const double none[3] = {};
  const Distance d = surface.at(p.data(), none, status);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_NEAR(std::hypot(d.normal[0], d.normal[1], d.normal[2]), 1, 1e-14);
  return d;
}

std::vector<Point<3>> random_points(double from, double to, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(from, to);
  std::vector<Point<3>> points(count);
  for (auto& p : points)
    for (double& x : p) x = coordinate(random);
  return points;
}

/// Signed distance to the cube [-1, 1]^3.
double cube_distance(const Point<3>& p) {
  Point<3> q;
  for (int k = 0; k < 3; ++k) q[k] = std::abs(p[k]) - 1;
  const double outside = std::hypot(std::max(q[0], 0.0), std::max(q[1], 0.0), std::max(q[2], 0.0));
  return outside > 0 ? outside : *std::ranges::max_element(q);
}

TEST(Surface, DistanceToACubeIsExactInsideAndOut) {
  for (const Surface& s : {cube(-1, 1), cube(-1, 1).reversed()}) {
    const auto surface = engine<3>().surface(TemporaryFile("cube.off", s.off()).path());
    for (const Point<3>& p : random_points(-2, 2, 3000)) EXPECT_NEAR(at(*surface, p).value, cube_distance(p), 1e-14);
  }
}

TEST(Surface, SignsAreRightNextToEdgesAndCorners) {
  const auto surface = engine<3>().surface(TemporaryFile("cube.off", cube(-1, 1).off()).path());
  for (const Point<3>& d : random_points(-1e-6, 1e-6, 3000))
    for (const Point<3>& p : {Point<3>{1 + d[0], 1 + d[1], 1 + d[2]}, Point<3>{1 + d[0], -1 + d[1], d[2]}})
      EXPECT_NEAR(at(*surface, p).value, cube_distance(p), 1e-15);
}

TEST(Surface, NormalsAreTheGradientOfTheDistance) {
  const auto surface = engine<3>().surface(TemporaryFile("cube.off", cube(-1, 1).off()).path());
  constexpr double step = 1e-5;
  for (const Point<3>& p : random_points(1.1, 2, 300)) {
    const Distance d = at(*surface, p);
    for (int k = 0; k < 3; ++k) {
      Point<3> left = p, right = p;
      left[k] -= step;
      right[k] += step;
      EXPECT_NEAR(d.normal[k], (at(*surface, right).value - at(*surface, left).value) / (2 * step), 1e-8);
    }
  }
  const Distance inside = at(*surface, {0.1, 0.2, 0.9});
  EXPECT_THAT(inside.normal, testing::ElementsAre(0, 0, 1));
}

TEST(Surface, NormalsOnTheSurfacePointOutwards) {
  const auto surface = engine<3>().surface(TemporaryFile("cube.off", cube(-1, 1).reversed().off()).path());
  EXPECT_THAT(at(*surface, {0.3, 0.1, 1}).normal, testing::ElementsAre(0, 0, 1));
  EXPECT_THAT(at(*surface, {0.3, -1, 0.2}).normal, testing::ElementsAre(0, -1, 0));
  const Distance corner = at(*surface, {1, 1, 1});
  for (const double n : corner.normal) EXPECT_NEAR(n, 1 / std::sqrt(3), 1e-14);
}

TEST(Surface, InsideOfAHollowCubeIsItsMaterial) {
  Surface hollow = cube(-2, 2);
  hollow.add(cube(-1, 1));
  const auto surface = engine<3>().surface(TemporaryFile("hollow.off", hollow.off()).path());
  EXPECT_NEAR(at(*surface, {0, 0, 0.5}).value, 0.5, 1e-15);
  EXPECT_NEAR(at(*surface, {0, 0, 1.25}).value, -0.25, 1e-15);
  EXPECT_THAT(at(*surface, {0, 0, 1.25}).normal, testing::ElementsAre(0, 0, -1));
}

/// The box [low, high].
Surface box_between(const Point<3>& low, const Point<3>& high) {
  Surface s = cube(0, 1);
  for (auto& p : s.points)
    for (std::size_t k = 0; k < 3; ++k) p[k] = low[k] + p[k] * (high[k] - low[k]);
  return s;
}

double box_distance(Point<3> p, const Point<3>& low, const Point<3>& high) {
  for (std::size_t k = 0; k < 3; ++k) p[k] = (2 * p[k] - low[k] - high[k]) / (high[k] - low[k]);
  for (std::size_t k = 0; k < 3; ++k) p[k] = (std::abs(p[k]) - 1) * (high[k] - low[k]) / 2;
  const double outside = std::hypot(std::max(p[0], 0.0), std::max(p[1], 0.0), std::max(p[2], 0.0));
  return outside > 0 ? outside : *std::ranges::max_element(p);
}

// A bar that ends in a block, passes through it, or ends flush with it: however they cross, and whichever way they are
// oriented, what is inside of either is inside.
TEST(Surface, ShellsThatCrossBoundWhatIsInsideOfAny) {
  struct Box {
    Point<3> low, high;
  };
  const Box block{{-1, -1, -1}, {1, 1, 1}};
  for (const Box& bar : {Box{{-0.3, -0.2, 0.5}, {0.2, 0.3, 3}}, Box{{-0.3, -0.2, -3}, {0.2, 0.3, 3}},
                         Box{{-0.3, -0.2, -1}, {0.2, 0.3, 3}}, Box{{-2, -0.2, 0.5}, {2, 0.3, 3}},
                         Box{{-2, -1, 0.5}, {2, 1, 3}}, Box{{0.5, 0.5, -2}, {2, 2, 2}}})
    for (const bool turned : {false, true}) {
      Surface both = turned ? box_between(block.low, block.high).reversed() : box_between(block.low, block.high);
      both.add(box_between(bar.low, bar.high));
      const auto surface = engine<3>().surface(TemporaryFile("both.off", both.off()).path());
      for (const Point<3>& p : random_points(-4, 4, 500)) {
        const double expected = std::min(box_distance(p, block.low, block.high), box_distance(p, bar.low, bar.high));
        const double found = at(*surface, p).value;
        EXPECT_EQ(found > 0, expected > 0) << p[0] << ' ' << p[1] << ' ' << p[2];
        if (expected > 0) {
          EXPECT_NEAR(found, expected, 1e-14);
        }
      }
    }
}

// A bar that is a little thicker at one end than at the other, whose end is inside a cone.
TEST(Surface, AnArrowIsInsideItsShaft) {
  for (const double thicker : {-0.001, 0.0, 0.001}) {
    Surface arrow;
    const int n = 10;
    const auto ring = [&](double y, double radius, double turn) {
      for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i + turn) / n;
        arrow.points.push_back({radius * std::cos(angle), y, radius * std::sin(angle)});
      }
    };
    ring(9.45, 0.5, 0.03);
    arrow.points.insert(arrow.points.end(), {{0, 9.45, 0}, {0, 10.45, 0}});
    ring(0, 0.2, 0);
    ring(9.7, 0.2 + thicker, 0);
    arrow.points.insert(arrow.points.end(), {{0, 0, 0}, {0, 9.7, 0}});
    const int first = n + 2, second = first + n, last = second + n;
    for (int i = 0, k = 1; i < n; ++i, k = (i + 1) % n) {
      arrow.triangles.push_back({i, n + 1, k});
      arrow.triangles.push_back({i, k, n});
      arrow.triangles.push_back({first + i, second + i, second + k});
      arrow.triangles.push_back({first + i, second + k, first + k});
      arrow.triangles.push_back({last, first + i, first + k});
      arrow.triangles.push_back({last + 1, second + k, second + i});
    }
    const auto surface = engine<3>().surface(TemporaryFile("arrow.off", arrow.off()).path());
    EXPECT_NEAR(at(*surface, {0.201, 5, 0}).value, 0.001, 0.001);
    EXPECT_LT(at(*surface, {0, 5, 0}).value, -0.18);
    EXPECT_LT(at(*surface, {0, 9.6, 0}).value, 0);
    EXPECT_GT(at(*surface, {0.4, 9.4, 0}).value, 0);
  }
}

// A spike into a block, up to its other side, or a cavity that touches the wall by a tip.
TEST(Surface, WhatTouchesItsOwnWallKeepsItsInside) {
  Surface spiked = cube(-1, 1);
  spiked.triangles.erase(spiked.triangles.begin() + 2, spiked.triangles.begin() + 4);
  spiked.points.push_back({0, 0.1, -1});
  for (const auto& [a, b] : {std::pair(4, 5), std::pair(5, 7), std::pair(7, 6), std::pair(6, 4)})
    spiked.triangles.push_back({a, b, 8});
  Surface hollow = cube(-1, 1);
  Surface cavity;
  for (const auto& p : {Point<3>{0.5, 0, 0}, Point<3>{-0.5, 0, 0}, Point<3>{0, 0.5, 0}, Point<3>{0, -0.5, 0},
                        Point<3>{0, 0.1, 1}, Point<3>{0, 0, -0.5}})
    cavity.points.push_back(p);
  cavity.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  hollow.add(cavity);
  const auto in_spike = engine<3>().surface(TemporaryFile("spiked.off", spiked.off()).path());
  EXPECT_GT(at(*in_spike, {0, 0, 0.9}).value, 0);
  EXPECT_LT(at(*in_spike, {0.9, 0.9, -0.9}).value, 0);
  EXPECT_GT(at(*in_spike, {1.5, 0, 0}).value, 0);
  const auto in_hollow = engine<3>().surface(TemporaryFile("hollow.off", hollow.off()).path());
  EXPECT_GT(at(*in_hollow, {0, 0, 0}).value, 0);
  EXPECT_LT(at(*in_hollow, {0.9, 0.9, 0.9}).value, 0);
  EXPECT_GT(at(*in_hollow, {1.5, 0, 0}).value, 0);
}

// A block in a cavity of a block.
TEST(Surface, ShellsWithinEachOtherAreInTurns) {
  Surface nested = cube(-1, 1);
  nested.add(cube(-3, 3)).add(cube(-2, 2));
  const auto surface = engine<3>().surface(TemporaryFile("nested.off", nested.off()).path());
  for (const auto& [x, expected] :
       {std::pair(0.5, -0.5), std::pair(1.25, 0.25), std::pair(2.25, -0.25), std::pair(3.25, 0.25)})
    EXPECT_NEAR(at(*surface, {x, 0, 0}).value, expected, 1e-14);
}

/// An open roof with the ridge x = 0, z = 0, its faces oriented upwards: z = slope |x|, a valley or a ridge.
Surface roof(double slope) {
  Surface s;
  for (const double y : {-9.0, 9.0})
    for (const double x : {-9.0, 0.0, 9.0}) s.points.push_back({x, y, slope * std::abs(x)});
  s.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  return s;
}

TEST(Surface, AnOpenSurfaceHasTheSidesOfItsFacesEvenAtASharpEdge) {
  for (const double slope : {-3.0, -0.2, 0.0, 0.2, 3.0}) {
    const auto surface = engine<3>().surface(TemporaryFile("roof.off", roof(slope).off()).path());
    const auto turned = engine<3>().surface(TemporaryFile("turned.off", roof(slope).reversed().off()).path());
    for (const Point<3>& p : random_points(-1, 1, 1000)) {
      const bool above = p[2] > slope * std::abs(p[0]);
      EXPECT_EQ(at(*surface, p).value > 0, above);
      EXPECT_EQ(at(*turned, p).value > 0, !above);
      EXPECT_NEAR(at(*surface, p).value, -at(*turned, p).value, 2e-14);  // the roof is up to 28 wide
    }
  }
}

TEST(Surface, AnOpenSurfaceHasTheSidesOfItsFacesAtAPeak) {
  Surface peak;  // a pyramid without its base, steep and pointing upwards
  peak.points = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 5}};
  peak.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const auto surface = engine<3>().surface(TemporaryFile("peak.off", peak.off()).path());
  for (Point<3> p : random_points(-0.5, 0.5, 1000)) {
    p[2] += 5;
    const bool outside = std::max(std::abs(p[0]), std::abs(p[1])) > (5 - p[2]) / 5;
    EXPECT_EQ(at(*surface, p).value > 0, outside);
  }
}

TEST(Surface, IsTheSameFromManyThreads) {
  const auto surface = engine<3>().surface(TemporaryFile("cube.off", cube(-1, 1).off()).path());
  const auto points = random_points(-2, 2, 4000);
  std::vector<std::vector<double>> values(4);
  {
    std::vector<std::jthread> threads;
    threads.reserve(values.size());
    for (auto& mine : values)
      threads.emplace_back([&] {
        Status status;
        const double none[3] = {};
        for (const auto& p : points) mine.push_back(surface->at(p.data(), none, status).value);
      });
  }
  for (const auto& mine : values) EXPECT_EQ(mine, values[0]);
}

TEST(Surface, RejectsPointsThatAreNotFinite) {
  const auto surface = engine<3>().surface(TemporaryFile("cube.off", cube(-1, 1).off()).path());
  for (const double bad : {std::nan(""), infinity}) {
    Status status;
    const double p[3] = {0, bad, 0};
    surface->at(p, p, status);
    EXPECT_EQ(status.code, static_cast<int>(Exit::input));
  }
}

TEST(Surface, NamesAFileThatIsMissing) {
  EXPECT_THAT(test::input_error_of([] { engine<3>().surface("/none.stl"); }), testing::HasSubstr("/none.stl"));
}

}  // namespace
}  // namespace signorini
