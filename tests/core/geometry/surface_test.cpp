#include <gmock/gmock.h>

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
    const auto surface = engine().surface(TemporaryFile("cube.off", s.off()).path());
    for (const Point<3>& p : random_points(-2, 2, 3000)) EXPECT_NEAR(at(*surface, p).value, cube_distance(p), 1e-14);
  }
}

TEST(Surface, SignsAreRightNextToEdgesAndCorners) {
  const auto surface = engine().surface(TemporaryFile("cube.off", cube(-1, 1).off()).path());
  for (const Point<3>& d : random_points(-1e-6, 1e-6, 3000))
    for (const Point<3>& p : {Point<3>{1 + d[0], 1 + d[1], 1 + d[2]}, Point<3>{1 + d[0], -1 + d[1], d[2]}})
      EXPECT_NEAR(at(*surface, p).value, cube_distance(p), 1e-15);
}

TEST(Surface, NormalsAreTheGradientOfTheDistance) {
  const auto surface = engine().surface(TemporaryFile("cube.off", cube(-1, 1).off()).path());
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
  const auto surface = engine().surface(TemporaryFile("cube.off", cube(-1, 1).reversed().off()).path());
  EXPECT_THAT(at(*surface, {0.3, 0.1, 1}).normal, testing::ElementsAre(0, 0, 1));
  EXPECT_THAT(at(*surface, {0.3, -1, 0.2}).normal, testing::ElementsAre(0, -1, 0));
  const Distance corner = at(*surface, {1, 1, 1});
  for (const double n : corner.normal) EXPECT_NEAR(n, 1 / std::sqrt(3), 1e-14);
}

TEST(Surface, InsideOfAHollowCubeIsItsMaterial) {
  Surface hollow = cube(-2, 2);
  hollow.add(cube(-1, 1));
  const auto surface = engine().surface(TemporaryFile("hollow.off", hollow.off()).path());
  EXPECT_NEAR(at(*surface, {0, 0, 0.5}).value, 0.5, 1e-15);
  EXPECT_NEAR(at(*surface, {0, 0, 1.25}).value, -0.25, 1e-15);
  EXPECT_THAT(at(*surface, {0, 0, 1.25}).normal, testing::ElementsAre(0, 0, -1));
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
    const auto surface = engine().surface(TemporaryFile("roof.off", roof(slope).off()).path());
    const auto turned = engine().surface(TemporaryFile("turned.off", roof(slope).reversed().off()).path());
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
  const auto surface = engine().surface(TemporaryFile("peak.off", peak.off()).path());
  for (Point<3> p : random_points(-0.5, 0.5, 1000)) {
    p[2] += 5;
    const bool outside = std::max(std::abs(p[0]), std::abs(p[1])) > (5 - p[2]) / 5;
    EXPECT_EQ(at(*surface, p).value > 0, outside);
  }
}

TEST(Surface, IsTheSameFromManyThreads) {
  const auto surface = engine().surface(TemporaryFile("cube.off", cube(-1, 1).off()).path());
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
  const auto surface = engine().surface(TemporaryFile("cube.off", cube(-1, 1).off()).path());
  for (const double bad : {std::nan(""), infinity}) {
    Status status;
    const double p[3] = {0, bad, 0};
    surface->at(p, p, status);
    EXPECT_EQ(status.code, static_cast<int>(Exit::input));
  }
}

TEST(Surface, NamesAFileThatIsMissing) {
  EXPECT_THAT(test::input_error_of([] { engine().surface("/none.stl"); }), testing::HasSubstr("/none.stl"));
}

}  // namespace
}  // namespace signorini
