#pragma once
#include <gtest/gtest.h>

#include "core/mesh/refine.hpp"
#include "mesh_samples.hpp"
#include "tests/core/mesh/mesh_checks.hpp"

namespace signorini::test {

/// A quadratic map, as curved elements of second order are images of flat ones under it, exactly.
inline Point<3> bent(const Point<3>& x) {
  return {x[0] + 0.05 * x[1] * x[1] - 0.03 * x[0] * x[2], x[1] + 0.04 * x[0] * x[1] + 0.02 * x[2] * x[2],
          x[2] - 0.03 * x[0] * x[0] + 0.02 * x[0] * x[1]};
}

/// Reads the image of a mesh under a quadratic map, with its nodes on edges: refined meshes are the images of refined
/// flat ones. With nodes in the middle of straight edges nothing differs from linear elements.
template <int D, class Read>
void expect_curved(const Mesh<D>& flat, const Read& read, bool vtk) {
  const auto place = [](Point<3> x) {
    if (D == 2) x[2] = 0;  // in files of plane meshes a constant
    Point<3> y = bent(x);
    if (D == 2) y[2] = 0.5;
    return y;
  };
  const auto middle = [](const Point<3>& a, const Point<3>& b) {
    return Point<3>{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  };
  Sample sample = second_order(sample_of(flat), middle, vtk);
  const auto straight = std::get<Mesh<D>>(read(sample));
  EXPECT_EQ(straight.points, flat.points);
  EXPECT_EQ(straight.elements, flat.elements);
  for (const Bends<D>& bends : straight.bends) EXPECT_EQ(bends, Bends<D>{});
  ASSERT_EQ(straight.curves.size(), 1u) << "nodes in the middle say that the edges are straight";

  for (Point<3>& p : sample.points) p = place(p);
  const auto curved = std::get<Mesh<D>>(read(sample));
  expect_consistent(curved);
  EXPECT_EQ(curved.parts.size(), straight.parts.size());
  ASSERT_EQ(curved.curves.size(), 1u);
  const MeshHierarchy<D> expected = hierarchy(flat, 3), found = hierarchy(curved, 3);
  EXPECT_TRUE(found.straightened.empty());
  for (std::size_t k = 0; k < 4; ++k) {
    // The octahedra may be cut along other diagonals, but vertices are the images of vertices.
    std::set<std::array<long, D>> places;
    const auto key = [](const auto& x) {
      std::array<long, D> out;
      for (int i = 0; i < D; ++i) out[i] = std::lround(1e9 * x[i]);
      return out;
    };
    for (const auto& p : found.levels[k].points) places.insert(key(p));
    ASSERT_EQ(found.levels[k].points.size(), expected.levels[k].points.size());
    if (D == 3 && k > 1) continue;  // vertices on diagonals differ
    for (const auto& p : expected.levels[k].points) {
      Point<3> x{};
      for (int i = 0; i < D; ++i) x[i] = p[i];
      EXPECT_EQ(places.count(key(place(x))), 1u) << "level " << k;
    }
  }
  expect_consistent(found.finest());
}

}  // namespace signorini::test
