#include "core/mesh/chords.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "core/geometry/body_geometry.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/build.hpp"
#include "core/mesh/join.hpp"
#include "core/mesh/refine.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/structured.hpp"

namespace signorini {
namespace {

using std::numbers::pi;

template <int D>
double sagitta_everywhere(const Mesh<D>& mesh, int refinements) {
  MeshHierarchy<D> meshes = hierarchy(mesh, refinements);
  return chord_sagitta(meshes, std::vector<bool>(meshes.finest().points.size(), true)).sagitta;
}

/// The strip 1 <= r <= 2 over a quarter of a circle or more, its arcs of n chords; in 3D times a height.
Mesh<2> arch(Index n, int quarters = 1) {
  Mesh<2> mesh = rectangle({0, 1}, {1, 2}, {n, 1});
  for (Point<2>& x : mesh.points) {
    const double angle = x[0] * quarters * pi / 2;
    x = {-x[1] * std::cos(angle), x[1] * std::sin(angle)};
  }
  return mesh;
}

Mesh<3> arch_3d(Index n, int quarters = 1) {
  Mesh<3> mesh = box({0, 1, 0}, {1, 2, 1}, {n, 1, 2});
  for (Point<3>& x : mesh.points) {
    const double angle = x[0] * quarters * pi / 2;
    x = {-x[1] * std::cos(angle), x[1] * std::sin(angle), x[2]};
  }
  return mesh;
}

TEST(Chords, SagittaIsThatOfTheArcsThroughTheVertices) {
  for (const Index n : {8, 16, 64})
    for (const int refinements : {0, 1, 2}) {
      const double exact = 2 * (1 - std::cos(pi / (4 * static_cast<double>(n))));  // of the outer arc
      EXPECT_NEAR(sagitta_everywhere(arch(n), refinements), exact, 0.01 * exact);
      EXPECT_NEAR(sagitta_everywhere(arch_3d(n), refinements), exact, 0.01 * exact);
    }
}

/// What a smooth surface through the vertices has taken the place of.
template <int D>
SmoothedOver smoothed_everywhere(Mesh<D> mesh) {
  geometry::give_geometry(mesh, geometry::Surfaces::smooth);
  const MeshHierarchy<D> meshes = hierarchy(std::move(mesh), 1);
  const Chords chords = chord_sagitta(meshes, std::vector<bool>(meshes.finest().points.size(), true));
  EXPECT_EQ(chords.sagitta, 0);
  return chords.smoothed;
}

TEST(Chords, WhatWasSmoothedOverIsToldWithItsAngle) {
  const double angle = pi / 16, sagitta = 2 * (1 - std::cos(angle / 2));
  for (const SmoothedOver& over : {smoothed_everywhere(arch(8)), smoothed_everywhere(arch_3d(8))}) {
    EXPECT_NEAR(over.angle, angle, 1e-9);
    EXPECT_NEAR(over.by, sagitta, 0.01 * sagitta);
  }
  EXPECT_EQ(smoothed_everywhere(rectangle({0, 0}, {3, 1}, {4, 3})).angle, 0);
}

/// Up to the angle that bodies have their creases by.
TEST(Chords, OfThirtyDegreesCount) {
  const double exact = 2 * (1 - std::cos(pi / 12));
  EXPECT_NEAR(sagitta_everywhere(arch(3), 1), exact, 0.02 * exact);
  EXPECT_NEAR(sagitta_everywhere(arch_3d(3), 1), exact, 0.02 * exact);
}

TEST(Chords, PolyhedraHaveNone) {
  EXPECT_EQ(sagitta_everywhere(rectangle({0, 0}, {3, 1}, {4, 3}), 2), 0);
  EXPECT_EQ(sagitta_everywhere(box({0, 0, 0}, {3, 1, 2}, {2, 3, 2}), 1), 0);
  EXPECT_EQ(sagitta_everywhere(arch(2), 1), 0) << "edges of 45 degrees";
}

// As a chamfer has it.
TEST(Chords, BetweenFlatPartsOfSeveralRowsAnEdgeIsMeant) {
  const auto bent = [](auto mesh) {
    for (auto& x : mesh.points)
      if (x[0] > 0) x[1] += std::tan(pi / 9) * x[0];
    return mesh;
  };
  EXPECT_EQ(sagitta_everywhere(bent(rectangle({-1, 0}, {1, 1}, {8, 3})), 1), 0);
  EXPECT_EQ(sagitta_everywhere(bent(box({-1, 0, 0}, {1, 1, 1}, {8, 3, 2})), 1), 0);
  EXPECT_GT(sagitta_everywhere(bent(rectangle({-1, 0}, {1, 1}, {2, 1})), 1), 0.04) << "two chords";
}

// An octagonal hole may be a round one. Hexagons may, too, and squares may not.
TEST(Chords, OfWideAnglesCountWhereTheyGoAround) {
  for (const Index n : {6, 8}) {
    const double exact = 2 * (1 - std::cos(pi / static_cast<double>(n)));
    EXPECT_NEAR(sagitta_everywhere(arch(n, 4), 1), exact, 0.03 * exact);
    EXPECT_NEAR(sagitta_everywhere(arch_3d(n, 4), 1), exact, 0.03 * exact);
  }
  EXPECT_EQ(sagitta_everywhere(arch(4, 4), 1), 0);
}

/// With nodes in the middle of all edges, where `middle` puts them.
template <int D, class Middle>
Mesh<D> second_order(const Mesh<D>& mesh, const Middle& middle) {
  RawMesh<D> raw;
  raw.points = mesh.points;
  raw.elements = mesh.elements;
  for (const auto& element : mesh.elements) {
    auto& through = raw.middle.emplace_back();
    for (std::size_t k = 0; k < through.size(); ++k) {
      const auto [a, b] = simplex_edges<D>()[k];
      through[k] = static_cast<Index>(raw.points.size());
      raw.points.push_back(middle(midpoint<D>(mesh.points[element[a]], mesh.points[element[b]])));
    }
  }
  return build_mesh<D>(std::move(raw), "test");
}

/// Turned about the first axis, or about the origin, moved and scaled.
template <int D>
Point<D> placed(double scale, Point<D> p) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  double &x = p[D - 2], &y = p[D - 1];
  std::tie(x, y) = std::pair(c * x - s * y, s * x + c * y);
  for (int k = 0; k < D; ++k) p[k] = scale * (p[k] + 3 - k);
  return p;
}

// A prism of many sides is one at the word of a file of second order with straight edges. A file of first order says
// nothing, nor does one with curved edges where the user asks for facets.
template <int D>
void expect_polyhedra_at_their_word(const Mesh<D>& arch) {
  using geometry::Surfaces;
  const double exact = 2 * (1 - std::cos(pi / 32));
  for (const double scale : {1e-3, 1.0, 1e3}) {
    Mesh<D> first = arch;
    for (Point<D>& p : first.points) p = placed<D>(scale, p);
    Mesh<D> straight = second_order(first, [](const Point<D>& p) { return p; });
    for (const Face<D>& face : straight.boundary) EXPECT_TRUE(face.straight);
    for (const Surfaces surfaces : {Surfaces::automatic, Surfaces::facets}) {
      Mesh<D> mesh = straight;
      geometry::give_geometry(mesh, surfaces);
      EXPECT_EQ(sagitta_everywhere(mesh, 1), 0);
      EXPECT_EQ(sagitta_everywhere(join<D>({mesh, first}, {"a", "b"}, {0, 0}), 0), sagitta_everywhere(first, 0));
    }
    EXPECT_NEAR(sagitta_everywhere(first, 1), scale * exact, 0.01 * scale * exact);
  }
  Mesh<D> curved = second_order(arch, [](Point<D> p) {
    const double r = std::hypot(p[0], p[1]), right = r > 1.5 ? 2 : 1;
    for (int k = 0; k < 2 && std::abs(r - right) < 0.02; ++k) p[k] *= right / r;  // not of edges across
    return p;
  });
  geometry::give_geometry(curved, Surfaces::facets);
  EXPECT_NEAR(sagitta_everywhere(curved, 1), exact, 0.01 * exact);
}

TEST(Chords, StraightEdgesOfSecondOrderAreMeant) {
  expect_polyhedra_at_their_word(arch(8));
  expect_polyhedra_at_their_word(arch_3d(8));
}

TEST(Chords, CountWhereVerticesAreMarked) {
  const MeshHierarchy<2> meshes = hierarchy(arch(16), 2);
  std::vector<bool> inner(meshes.finest().points.size());
  for (std::size_t p = 0; p < inner.size(); ++p)
    inner[p] = std::hypot(meshes.finest().points[p][0], meshes.finest().points[p][1]) < 1.0 + 1e-9;
  const double exact = 1 - std::cos(pi / 64);
  EXPECT_NEAR(chord_sagitta(meshes, inner).sagitta, exact, 0.01 * exact);
  EXPECT_EQ(chord_sagitta(meshes, std::vector<bool>(inner.size())).sagitta, 0);
}

}  // namespace
}  // namespace signorini
