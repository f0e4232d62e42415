#include "core/mesh/point_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace signorini {
namespace {

using Tree = PointTree<3>;

std::vector<Index> all(const std::vector<Point<3>>& points) {
  std::vector<Index> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Those of a lattice of n x n on a face of the unit cube.
std::vector<Point<3>> lattice(int n) {
  std::vector<Point<3>> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) points.push_back({double(i) / n, double(j) / n, 0});
  return points;
}

bool near(const Tree::Box& box, const Point<3>& x, double reach) {
  for (int k = 0; k < 3; ++k)
    if (box.low[k] > x[k] + reach || box.high[k] < x[k] - reach) return false;
  return true;
}

TEST(PointTree, FindsEveryPointOfAnyBox) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<Point<3>> points(500);
  for (auto& point : points) point = {number(random), number(random), number(random)};
  const Tree tree(points, all(points));
  for (int k = 0; k < 100; ++k) {
    const Point<3> middle{number(random), number(random), number(random)};
    std::vector<int> found(points.size());
    tree.search([&](const Tree::Box& box) { return near(box, middle, 0.2); }, [&](Index v) { ++found[v]; });
    for (std::size_t v = 0; v < points.size(); ++v) {
      EXPECT_LE(found[v], 1);
      EXPECT_GE(found[v], near({points[v], points[v]}, middle, 0.2) ? 1 : 0);
    }
  }
}

/// Searches around every point look at boxes and points whose numbers grow like the logarithm of that of the points.
TEST(PointTree, SearchesLookAtFewBoxesAndPoints) {
  const auto looks = [](int n) {
    const std::vector<Point<3>> points = lattice(n);
    const Tree tree(points, all(points));
    double boxes = 0, visited = 0;
    for (const Point<3>& x : points)
      tree.search([&](const Tree::Box& box) { return ++boxes, near(box, x, 1.0 / n); }, [&](Index) { ++visited; });
    return std::pair{boxes / points.size(), visited / points.size()};
  };
  for (const int n : {8, 16, 32, 64, 128}) {
    const auto [boxes, visited] = looks(n);
    EXPECT_LE(boxes, 6 * std::log2(n * n)) << n;
    EXPECT_LE(visited, 50) << n;
  }
}

}  // namespace
}  // namespace signorini
