// How deep two bodies overlap: whatever vertices and faces coincide, in any place, size and position.
#include "core/fem/pairs/overlap.hpp"

#include <gtest/gtest.h>

#include "core/mesh/join.hpp"
#include "support.hpp"

namespace signorini::testing {
namespace {

template <int D>
struct Block {
  Point<D> from, to;
  std::array<Index, D> cells;
};

template <int D>
Mesh<D> mesh_of(const Block<D>& b) {
  if constexpr (D == 2)
    return rectangle(b.from, b.to, b.cells);
  else
    return box(b.from, b.to, b.cells);
}

template <int D>
Point<D> moved(const Point<D>& x, double scale, double shift) {
  const auto Q = rotation<D>();
  Point<D> out;
  for (int i = 0; i < D; ++i) {
    out[i] = shift;
    for (int j = 0; j < D; ++j) out[i] += scale * Q(i, j) * x[j];
  }
  return out;
}

template <int D>
BodyFaces faces(const Mesh<D>& mesh, const std::string& body, const std::string& part) {
  const auto some = [&](const std::string& name) {
    std::vector<Index> out;
    for (const Part& p : mesh.parts)
      if (p.name == part_of(body, name)) out = p.faces;
    if (name == "boundary")
      for (const char* side : {"left", "right", "bottom", "top", "front", "back"})
        for (const Part& p : mesh.parts)
          if (p.name == part_of(body, side)) out.insert(out.end(), p.faces.begin(), p.faces.end());
    std::ranges::sort(out);
    return out;
  };
  return {some(part), some("boundary")};
}

/// The same in all places and sizes, whichever body is the slave.
template <int D>
void expect_depth(const Block<D>& low, const Block<D>& up, double depth, const std::string& on = "bottom",
                  const std::string& other_on = "top") {
  const Mesh<D> mesh = join<D>({mesh_of(low), mesh_of(up)}, {"low", "up"}, {0, 0});
  const BodyFaces of_low = faces(mesh, "low", other_on), of_up = faces(mesh, "up", on);
  for (const double scale : {1.0, 1e-6, 1e6})
    for (const double shift : {0.0, 300.0}) {
      std::vector<Point<D>> points;
      for (const Point<D>& x : mesh.points) points.push_back(moved<D>(x, scale, shift * scale));
      for (const auto& [slave, master] : {std::pair(of_up, of_low), std::pair(of_low, of_up)}) {
        const Overlap<D> found = find_overlap<D>(mesh, points, slave, master);
        EXPECT_NEAR(found.depth, scale * depth, scale * 1e-9) << scale << ' ' << shift;
        if (depth > 0) {
          EXPECT_TRUE(std::ranges::binary_search(slave.touching, found.slave_face));
        }
      }
    }
}

TEST(FindOverlap, OfAlignedColumns) {
  for (const Index n : {1, 2}) {
    expect_depth<2>({{-0.2, 0}, {0.2, 0.4}, {n, 2}}, {{-0.2, 0.39}, {0.2, 0.8}, {1, 2}}, 0.01);
    expect_depth<3>({{-0.2, -0.2, 0}, {0.2, 0.2, 0.4}, {n, n, 1}}, {{-0.2, -0.2, 0.39}, {0.2, 0.2, 0.8}, {1, 1, n}},
                    0.01);
  }
}

TEST(FindOverlap, OfCrossedBars) {
  const Block<3> low{{-1, -0.2, 0}, {1, 0.2, 0.4}, {1, 1, 1}};
  expect_depth<3>(low, {{-0.2, -1, 0.39}, {0.2, 1, 0.8}, {1, 1, 1}}, 0.01);
  expect_depth<3>(low, {{-0.2, -1, 0.39}, {0.2, 1, 0.8}, {1, 1, 1}}, 0.01, "boundary", "boundary");
  expect_depth<3>(low, {{-0.2, -1, 0.1}, {0.2, 1, 0.3}, {1, 1, 1}}, 0.3);  // right through it
}

TEST(FindOverlap, OfBlocksWithCommonEdges) {
  expect_depth<2>({{0, 0}, {1, 1}, {1, 1}}, {{0, 0.9}, {0.5, 2}, {1, 1}}, 0.1);
  expect_depth<2>({{0, 0}, {1, 1}, {1, 1}}, {{-0.5, 0.9}, {0.5, 2}, {1, 1}}, 0.1);
  expect_depth<2>({{0, 0}, {1, 1}, {1, 1}}, {{-0.5, 0.9}, {1.5, 2}, {1, 1}}, 0.1);
  expect_depth<3>({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {{0, -1, 0.9}, {1, 0.5, 2}, {1, 1, 1}}, 0.1);
  expect_depth<3>({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {{0.5, -1, 0.9}, {2, 2, 2}, {1, 1, 1}}, 0.1);
}

TEST(FindOverlap, OfABodyInsideAnotherOne) {
  expect_depth<2>({{0, 0}, {4, 4}, {1, 1}}, {{1, 2}, {2, 3}, {1, 1}}, 2);
  expect_depth<3>({{0, 0, 0}, {4, 4, 4}, {1, 1, 1}}, {{1, 1, 2}, {2, 2, 3}, {1, 1, 1}}, 2);
}

// Nothing of one is inside the other one, whatever they have in common.
TEST(FindOverlap, OfBodiesThatTouchIsNone) {
  for (const char* on : {"bottom", "boundary"})
    for (const char* other_on : {"top", "boundary"}) {
      expect_depth<2>({{0, 0}, {1, 1}, {1, 1}}, {{0, 1}, {1, 2}, {1, 1}}, 0, on, other_on);
      expect_depth<2>({{0, 0}, {1, 1}, {1, 1}}, {{1, 0.5}, {2, 2}, {1, 1}}, 0, on, other_on);
      expect_depth<2>({{0, 0}, {1, 1}, {1, 1}}, {{1, 0}, {2, 1}, {2, 2}}, 0, on, other_on);
      expect_depth<3>({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {{0, 0, 1}, {1, 1, 2}, {1, 1, 1}}, 0, on, other_on);
      expect_depth<3>({{0, 0, 0}, {1, 1, 1}, {2, 1, 1}}, {{1, 0, 0}, {2, 1, 1}, {1, 1, 2}}, 0, on, other_on);
      expect_depth<3>({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {{0.3, 1, 0.5}, {2, 2, 3}, {1, 1, 1}}, 0, on, other_on);
    }
}

}  // namespace
}  // namespace signorini::testing
