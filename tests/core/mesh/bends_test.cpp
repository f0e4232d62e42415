// Curved elements: children are pieces of the same quadratic map; what would be turned inside out stays straight.
#include "core/mesh/bends.hpp"

#include <random>

#include "core/mesh/build.hpp"
#include "core/mesh/families.hpp"
#include "core/mesh/refine.hpp"
#include "mesh_checks.hpp"

namespace signorini {
namespace {

/// The quadratic map of an element at barycentric coordinates.
template <int D>
Point<D> image(const std::array<Point<D>, D + 1>& corner, const Bends<D>& bends, const std::array<double, D + 1>& x) {
  constexpr auto edges = simplex_edges<D>();
  Point<D> out{};
  for (int d = 0; d < D; ++d) {
    for (int i = 0; i <= D; ++i) out[d] += x[i] * corner[i][d];
    for (std::size_t k = 0; k < edges.size(); ++k) out[d] += 4 * x[edges[k][0]] * x[edges[k][1]] * bends[k][d];
  }
  return out;
}

template <int D>
void expect_children_of_the_same_map() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  constexpr auto edges = simplex_edges<D>();
  std::array<Point<D>, D + 1> corner;
  Bends<D> bends;
  for (auto& p : corner)
    for (double& x : p) x = number(random);
  for (auto& p : bends)
    for (double& x : p) x = number(random);
  const auto barycentric = [&](int node) {
    std::array<double, D + 1> x{};
    if (node <= D)
      x[node] = 1;
    else
      for (const int end : edges[node - D - 1]) x[end] = 0.5;
    return x;
  };
  for (std::size_t c = 0; c < RedRefinement<D>::children.size(); ++c) {
    const auto& child = RedRefinement<D>::children[c];
    std::array<Point<D>, D + 1> own;
    for (int i = 0; i <= D; ++i) own[i] = image<D>(corner, bends, barycentric(child[i]));
    const Bends<D> found = bends_of_child<D>(bends, c);
    for (int trial = 0; trial < 5; ++trial) {
      std::array<double, D + 1> x, whole{};
      double sum = 0;
      for (double& v : x) sum += v = 1 + number(random);
      for (double& v : x) v /= sum;
      for (int i = 0; i <= D; ++i)
        for (int k = 0; k <= D; ++k) whole[k] += x[i] * barycentric(child[i])[k];
      const Point<D> a = image<D>(own, found, x), b = image<D>(corner, bends, whole);
      for (int d = 0; d < D; ++d) EXPECT_NEAR(a[d], b[d], 1e-13);
    }
  }
}

TEST(Bends, ChildrenArePiecesOfTheSameQuadraticMap) {
  expect_children_of_the_same_map<2>();
  expect_children_of_the_same_map<3>();
}

RawMesh<2> triangle(const Point<2>& middle) {
  return {.points = {{0, 0}, {1, 0}, {0, 1}, middle},
          .elements = {{0, 2, 1}},
          .middle = {{-1, -1, 3}},
          .label = {},
          .groups = {}};
}

TEST(Bends, OfElementsNumberedTheOtherWayRoundAreTurnedWithThem) {
  const Mesh<2> mesh = build_mesh<2>(triangle({0.6, 0.6}), "test");
  ASSERT_EQ(mesh.points.size(), 3u);
  Mesh<2> fine;
  EXPECT_TRUE(refine_uniformly(mesh, fine).straightened.empty());
  EXPECT_EQ(std::ranges::count(fine.points, Point<2>{0.6, 0.6}), 1);
  EXPECT_EQ(std::ranges::count_if(mesh.boundary, [](const auto& f) { return f.curve == 0; }), 1);
  // The triangle and the parabola's segment on its longest side: two thirds of chord times height.
  EXPECT_NEAR(test::volume(hierarchy(mesh, 8).finest()), 0.5 + 2.0 / 3 * std::sqrt(2) * 0.1 * std::sqrt(2), 1e-5);
}

/// Turned by 0.7, moved and scaled.
Point<2> placed(double scale, const Point<2>& p) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {scale * (c * p[0] - s * p[1] + 2), scale * (s * p[0] + c * p[1] - 5)};
}

TEST(Bends, WhatWouldBeTurnedInsideOutStaysStraightAndIsToldWithItsPlace) {
  const MeshHierarchy<2> fine = hierarchy(build_mesh<2>(triangle({-0.2, -0.2}), "test"), 2);
  ASSERT_FALSE(fine.straightened.empty());
  test::expect_consistent(fine.finest());
  // Half of the way to (-0.2, -0.2) twice: a quarter of it from the middle of the edge.
  EXPECT_NEAR(fine.straightened[0][0], fine.straightened[0][1], 1e-15);
  EXPECT_GT(fine.straightened[0][0], -0.2);
  EXPECT_LT(fine.straightened[0][0], 0.5);
  for (const double scale : {1e-3, 1.0, 1e3}) {
    RawMesh<2> raw = triangle({-0.2, -0.2});
    for (Point<2>& p : raw.points) p = placed(scale, p);
    const MeshHierarchy<2> there = hierarchy(build_mesh<2>(raw, "test"), 2);
    ASSERT_EQ(there.straightened.size(), fine.straightened.size());
    for (std::size_t k = 0; k < fine.straightened.size(); ++k)
      EXPECT_LT(length<2>(difference<2>(there.straightened[k], placed(scale, fine.straightened[k]))), 1e-12 * scale);
  }
}

// The linear children are all right, the quadratic element is not.
TEST(Bends, QuadraticElementsThatWouldBeTurnedInsideOutAreStraightened) {
  MeshHierarchy<2> fine = hierarchy(build_mesh<2>(triangle({0.8, 0.2}), "test"), 1);
  EXPECT_TRUE(fine.straightened.empty());
  const std::vector<Index> at = straighten_families(fine.levels.back());
  ASSERT_EQ(at.size(), 1u);
  EXPECT_EQ(fine.finest().points[at[0]], (Point<2>{0.5, 0.5}));
  EXPECT_EQ(std::ranges::count(fine.finest().points, Point<2>{0.5, 0.5}), 1);
  fine = hierarchy(build_mesh<2>(triangle({0.6, 0.4}), "test"), 1);
  EXPECT_TRUE(straighten_families(fine.levels.back()).empty());
}

TEST(Bends, NodesTooFarAwayToCountAreRefused) {
  EXPECT_THAT(test::input_error_of([] {
                build_mesh<2>(triangle({1.7e308, -1.7e308}), "file.msh");
              }),
              testing::HasSubstr("too far away"));
  EXPECT_THAT(test::input_error_of([] {
                build_mesh<2>(triangle({3, 3}), "file.msh");
              }),
              testing::HasSubstr("goes through (3, 3), which is farther from its middle than the edge is long"));
}

TEST(Bends, ElementsThatDoNotAgreeOnAnEdgeAreRefused) {
  RawMesh<2> raw{.points = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0.6, 0.6}, {0.5, 0.6}},
                 .elements = {{0, 1, 2}, {1, 3, 2}},
                 .middle = {{-1, -1, 4}, {-1, 5, -1}},
                 .label = {},
                 .groups = {}};
  EXPECT_THAT(
      test::input_error_of([&] { build_mesh<2>(raw, "file.msh"); }),
      testing::AllOf(testing::HasSubstr("file.msh"), testing::HasSubstr("element 1 has another node in the middle "
                                                                        "of the edge from (1, 0) to (0, 1)")));
}

}  // namespace
}  // namespace signorini
