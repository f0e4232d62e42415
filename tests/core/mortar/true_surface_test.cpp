// Faces that stand for shapes: distances and normals are those of the shapes, however coarse the faces are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/mesh/true_surface.hpp"
#include "tests/core/mortar/surfaces.hpp"

namespace signorini::test {
namespace {

constexpr double gap = 1e-5;

/// A part of the surface of a circle or a cylinder around the last axis, of height 1, as a mesh has it.
template <int D>
Mesh<D> arc(double radius, int around, bool outwards, Random& random, double angle = std::numbers::pi / 2) {
  const int along = D == 2 ? 0 : 3;
  Mesh<D> mesh;
  Curve<D> curve{.radius = radius};
  if constexpr (D == 3) curve.kind = CurveKind::cylinder, curve.axis = {0, 0, 1};
  mesh.curves = {curve};
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i <= around; ++i) {
      const double at = angle * (i == 0 || i == around ? i : i + 0.2 * random.between(-1, 1)) / around;
      Point<D> x{radius * std::cos(at), radius * std::sin(at)};
      if constexpr (D == 3) x[2] = double(j) / along;
      mesh.points.push_back(x);
    }
  const auto add = [&](std::array<Index, D> corners) {
    if (!outwards) std::swap(corners[0], corners[1]);
    mesh.boundary.push_back({.vertices = corners, .element = -1, .curve = 0});
  };
  for (Index i = 0; i < around; ++i)
    if constexpr (D == 2)
      add({i, i + 1});
    else
      for (Index j = 0; j < along; ++j) {
        const Index a = j * (around + 1) + i, b = a + 1, c = a + around + 1, d = c + 1;
        add({a, b, d});
        add({a, d, c});
      }
  return mesh;
}

/// What a mesh's boundary is to couple().
template <int D>
struct Faces {
  std::vector<Point<D>> points;
  std::vector<std::array<Index, D>> corners;
  std::vector<Index> number;

  explicit Faces(const Mesh<D>& mesh) : points(mesh.points), number(mesh.boundary.size()) {
    for (const Face<D>& face : mesh.boundary) corners.push_back(face.vertices);
    std::iota(number.begin(), number.end(), 0);
  }
  SurfaceFaces<D> side(const Mesh<D>& mesh) const { return {points, corners, "surface", 1, &mesh, number}; }
};

/// Along the z-axis a point has no part in it.
template <int D>
double off_radius(const Point<D>& normal, const Point<D>& x) {
  return std::abs(normal[0] * x[1] - normal[1] * x[0]) / std::hypot(x[0], x[1]);
}

template <int D>
void expect_distance_of_shapes(int inner_cells, int outer_cells, bool inner_is_slave, Pairing pairing) {
  SCOPED_TRACE(fmt::format("{}:{} {}", inner_cells, outer_cells, inner_is_slave));
  Random random(7);
  const Mesh<D> inner = arc<D>(2, inner_cells, true, random), outer = arc<D>(2 + gap, outer_cells, false, random);
  const Faces<D> in(inner), out(outer);
  const auto found = inner_is_slave ? couple<D>(in.side(inner), out.side(outer), within(0.5, pairing))
                                    : couple<D>(out.side(outer), in.side(inner), within(0.5, pairing));
  ASSERT_GT(found.nodes(), inner_is_slave ? inner_cells : outer_cells);
  for (Index k = 0; k < found.nodes(); ++k) {
    EXPECT_NEAR(found.gap[k], gap, 1e-2 * gap);
    EXPECT_NEAR(found.nearest[k], gap, 1e-2 * gap);
    EXPECT_NEAR(found.farthest[k], gap, 1e-2 * gap);
    const auto& x = (inner_is_slave ? in : out).points[found.node[k]];
    if (pairing == Pairing::normal) {
      EXPECT_LT(off_radius<D>(found.normal[k], x), 2e-3);
    }
  }
  EXPECT_EQ(found.deepest.depth, 0);
}

/// What turns about the axis makes no jump along the normal, neither of both sides nor of one.
template <int D>
void expect_free_turning(int inner_cells, int outer_cells, bool inner_is_slave) {
  SCOPED_TRACE(fmt::format("{}:{} {}", inner_cells, outer_cells, inner_is_slave));
  Random random(11);
  const Mesh<D> inner = arc<D>(2, inner_cells, true, random), outer = arc<D>(2, outer_cells, false, random);
  const Faces<D> in(inner), out(outer);
  const auto found = inner_is_slave ? couple<D>(in.side(inner), out.side(outer), within(0.5))
                                    : couple<D>(out.side(outer), in.side(inner), within(0.5));
  const auto& own = (inner_is_slave ? in : out).points;
  const auto& other = (inner_is_slave ? out : in).points;
  for (Index k = 0; k < found.nodes(); ++k) {
    const Point<D>& n = found.normal[k];
    Point<D> mean{};
    double sum = 0;
    for (Offset e = found.row[k]; e < found.row[k + 1]; ++e) {
      sum += found.value[e];
      for (int i = 0; i < D; ++i) mean[i] += found.value[e] * other[found.column[e]][i];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    for (const Point<D>& x : {own[found.node[k]], mean}) EXPECT_NEAR(n[1] * x[0] - n[0] * x[1], 0, 1e-12);
    if constexpr (D == 3) {
      EXPECT_NEAR(mean[2], own[found.node[k]][2], 1e-12);
    }
  }
}

template <class N>
class TrueSurface : public testing::Test {};
TYPED_TEST_SUITE(TrueSurface, Dimensions);

TYPED_TEST(TrueSurface, DistancesAreThoseOfShapes) {
  for (const bool inner_is_slave : {false, true}) {
    expect_distance_of_shapes<TypeParam::value>(10, 37, inner_is_slave, Pairing::normal);
    expect_distance_of_shapes<TypeParam::value>(23, 9, inner_is_slave, Pairing::normal);
  }
}

TYPED_TEST(TrueSurface, WhatIsRoundIsFreeToTurn) {
  for (const bool inner_is_slave : {false, true}) {
    expect_free_turning<TypeParam::value>(10, 23, inner_is_slave);
    expect_free_turning<TypeParam::value>(14, 14, inner_is_slave);
  }
}

// As much off displaced faces as off those where they were.
TYPED_TEST(TrueSurface, DisplacedFacesKeepTheirShape) {
  constexpr int D = TypeParam::value;
  Random random(3);
  const Mesh<D> inner = arc<D>(2, 10, true, random), outer = arc<D>(2 + gap, 37, false, random);
  Faces<D> in(inner);
  const Faces<D> out(outer);
  for (Point<D>& x : in.points)
    for (int k = 0; k < 2; ++k) x[k] *= 1 + gap;
  const auto found = couple<D>(in.side(inner), out.side(outer), within(0.5));
  for (Index k = 0; k < found.nodes(); ++k) EXPECT_NEAR(found.gap[k], -gap, 1e-2 * gap);
  EXPECT_NEAR(found.deepest.depth, gap, 1e-2 * gap);
}

// Where refinement could not put a vertex on the shape the face is what it is.
TYPED_TEST(TrueSurface, FacesOffTheirShapeStandForThemselves) {
  constexpr int D = TypeParam::value;
  Random random(3);
  Mesh<D> mesh = arc<D>(2, 10, true, random);
  EXPECT_TRUE(stands_for_surface(mesh, 0));
  for (int k = 0; k < 2; ++k) mesh.points[0][k] *= 0.99;
  EXPECT_FALSE(stands_for_surface(mesh, 0));
  mesh.boundary[1].curve = -1;
  EXPECT_FALSE(stands_for_surface(mesh, 1));
}

// Along any direction up to where the surface is.
TEST(SurfaceOfAFace, IsMetAlongLines) {
  Mesh<2> mesh;
  mesh.curves = {Curve<2>{.center = {1, 0}, .radius = 2}};
  mesh.points = {{3, 0}, {1, 2}};
  mesh.boundary = {{.vertices = {0, 1}, .element = -1, .curve = 0}};
  for (const double angle : {0.3, 0.7, 1.2}) {
    const Point<2> along{std::cos(angle), std::sin(angle)};
    const auto at = surface_at<2>(mesh, 0, {0.3, 0.7}, along);
    const Point<2> x{1.6 + at.height * along[0], 1.4 + at.height * along[1]};
    EXPECT_NEAR(std::hypot(x[0] - 1, x[1]), 2, 1e-12);
    EXPECT_NEAR(at.normal[0], (x[0] - 1) / 2, 1e-12);
    EXPECT_NEAR(at.normal[1], x[1] / 2, 1e-12);
  }
}

// A patch of which the face is the second half.
TEST(SurfaceOfAFace, IsThatOfPatches) {
  Mesh<2> mesh;
  CubicPatch<2> patch;
  patch.control = {{{0, 0}, {1, 0}, {1.0 / 3, -0.2}, {2.0 / 3, -0.2}}};
  mesh.curves = {Curve<2>{.kind = CurveKind::patches}};
  mesh.patches = std::make_shared<const std::vector<CubicPatch<2>>>(1, patch);
  mesh.refinements = 1;
  mesh.points = {{0, 0}, patch.at({0.5, 0.5}), {1, 0}};
  mesh.boundary = {{.vertices = {0, 1}, .element = -1, .curve = 0}, {.vertices = {1, 2}, .element = -1, .curve = 0}};
  ASSERT_TRUE(stands_for_surface(mesh, 1));
  const auto at = surface_at<2>(mesh, 1, {0.5, 0.5}, {0, -1});
  EXPECT_NEAR(mesh.points[1][1] / 2 - at.height, patch.at({0.25, 0.75})[1], 1e-12);
}

}  // namespace
}  // namespace signorini::test
