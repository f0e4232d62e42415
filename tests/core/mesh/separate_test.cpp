#include "core/mesh/separate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/mesh/boundary.hpp"
#include "core/mesh/refine.hpp"
#include "core/mesh/validate.hpp"

namespace signorini {
namespace {

template <int D>
int most_curved_faces(const Mesh<D>& mesh) {
  std::map<Index, int> faces;
  int most = 0;
  for (const Face<D>& face : mesh.boundary) most = std::max(most, ++faces[face.element]);
  return most;
}

template <int D>
Mesh<D> inscribed(std::vector<Point<D>> points, std::vector<std::array<Index, D + 1>> elements) {
  Mesh<D> mesh;
  mesh.points = std::move(points);
  mesh.elements = std::move(elements);
  mesh.boundary = find_boundary<D>(mesh.vertices(), mesh.elements);
  mesh.curves.push_back({{}, 1.0});
  for (Face<D>& face : mesh.boundary) face.curve = 0;
  return mesh;
}

// A square in a circle, cut along a diagonal, and an octahedron in a sphere, four tetrahedra around its axis.
Mesh<2> square() { return inscribed<2>({{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, {{0, 1, 2}, {0, 2, 3}}); }
Mesh<3> octahedron() {
  return inscribed<3>({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                      {{0, 1, 5, 4}, {1, 2, 5, 4}, {2, 3, 5, 4}, {3, 0, 5, 4}});
}

template <int D>
void expect_separated(Mesh<D> mesh) {
  const std::size_t faces = mesh.boundary.size(), elements = mesh.elements.size();
  ASSERT_EQ(most_curved_faces(mesh), 2);
  separate_curved_faces(mesh);
  EXPECT_EQ(most_curved_faces(mesh), 1);
  EXPECT_EQ(mesh.boundary.size(), faces);
  EXPECT_EQ(mesh.elements.size(), 2 * elements);
  EXPECT_NO_THROW(validate(mesh, "separated"));
  for (const Face<D>& face : find_boundary<D>(mesh.vertices(), mesh.elements)) {
    const auto same = [&](const Face<D>& f) { return f.element == face.element && f.vertices == face.vertices; };
    EXPECT_TRUE(std::any_of(mesh.boundary.begin(), mesh.boundary.end(), same));
  }
}

TEST(Separate, LeavesOneCurvedFacePerTriangle) { expect_separated(square()); }
TEST(Separate, LeavesOneCurvedFacePerTetrahedron) { expect_separated(octahedron()); }

TEST(Separate, LeavesOtherMeshesAsTheyAre) {
  Mesh<2> mesh = square();
  for (Face<2>& face : mesh.boundary) face.curve = -1;
  separate_curved_faces(mesh);
  EXPECT_EQ(mesh.elements, square().elements);
  EXPECT_EQ(mesh.points, square().points);
}

}  // namespace
}  // namespace signorini
