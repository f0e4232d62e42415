#include "core/mesh/mirror.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/refine.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/structured.hpp"

namespace signorini {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Mirror, FacesOnItAreNoBoundary) {
  Mesh<2> mesh = rectangle({0, 0}, {2, 1}, {4, 2});
  mesh.points[0][0] = 1e-9;  // up to rounding
  add_mirror(mesh, {.axis = 0, .at = 0}, "here");
  EXPECT_EQ(mesh.points[0][0], 0);
  remove_faces_on_mirrors(mesh);
  EXPECT_EQ(mesh.boundary.size(), 10u);
  const auto faces = [&](const char* name) { return std::ranges::find(mesh.parts, name, &Part::name)->faces; };
  EXPECT_TRUE(faces("left").empty());
  EXPECT_EQ(faces("right").size(), 2u);
  for (const Index f : faces("right"))
    for (const Index v : mesh.boundary[f].vertices) EXPECT_EQ(mesh.points[v][0], 2);
}

TEST(Mirror, TheMeshLiesOnOneSide) {
  Mesh<2> mesh = rectangle({-1, 0}, {2, 1}, {3, 2});
  EXPECT_THAT(
      [&] { add_mirror(mesh, {.axis = 0, .at = 0}, "scene.toml:3"); },
      ThrowsMessage<Error>(testing::AllOf(HasSubstr("scene.toml:3"), HasSubstr("x = 0"), HasSubstr("-1 to 2"))));
  EXPECT_THAT([&] { add_mirror(mesh, {.axis = 1, .at = 2}, "scene.toml:3"); },
              ThrowsMessage<Error>(HasSubstr("no face on the plane of symmetry y = 2")));
}

/// The cap of a ball, whose centre is below the plane: refinement keeps the rim on both.
TEST(Mirror, RimsStayOnPlaneAndCurve) {
  const double R = 1.25, below = 0.75, rim = std::sqrt(R * R - below * below);
  Mesh<3> mesh;
  for (int k = 0; k < 3; ++k)
    mesh.points.push_back({rim * std::cos(2 * std::acos(-1) / 3 * k), rim * std::sin(2 * std::acos(-1) / 3 * k), 0});
  mesh.points.push_back({0, 0, R - below});
  mesh.elements = {{0, 1, 2, 3}};
  mesh.boundary = find_boundary<3>(4, mesh.elements);
  mesh.curves = {{.center = {0, 0, -below}, .radius = R}};
  for (Face<3>& face : mesh.boundary)
    if (std::ranges::count(face.vertices, 3) > 0) face.curve = 0;
  add_mirror(mesh, {.axis = 2, .at = 0}, "here");
  remove_faces_on_mirrors(mesh);
  Mesh<3> fine;
  refine_uniformly(mesh, fine);
  int on_rim = 0;
  for (const Point<3>& x : fine.points) {
    EXPECT_NEAR(length<3>(difference<3>(x, {0, 0, -below})), R, 1e-9);
    on_rim += x[2] == 0;
  }
  EXPECT_EQ(on_rim, 6);
  EXPECT_EQ(fine.mirrors.size(), 1u);
}

}  // namespace
}  // namespace signorini
