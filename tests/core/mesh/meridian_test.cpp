#include "core/mesh/meridian.hpp"

#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/structured.hpp"

namespace signorini {
namespace {

using testing::HasSubstr;

TEST(Meridian, TheAxisIsNoBoundary) {
  Mesh<2> mesh = rectangle({0, 0}, {2, 1}, {4, 3});
  for (Point<2>& x : mesh.points)
    if (x[0] == 0 && x[1] > 0.5) x[0] = -1e-12;  // as files have it
  const std::size_t before = mesh.boundary.size();
  read_as_meridian(mesh, "here");
  EXPECT_EQ(mesh.boundary.size(), before - 3);
  for (const Point<2>& x : mesh.points) EXPECT_TRUE(x[0] == 0 || x[0] > 0.1);
  EXPECT_TRUE(faces_of(mesh, "left", "here").empty());
  for (const char* part : {"bottom", "top"}) {
    EXPECT_EQ(faces_of(mesh, part, "here").size(), 4u);
    for (const Index f : faces_of(mesh, part, "here"))
      for (const Index v : mesh.boundary[f].vertices) EXPECT_EQ(mesh.points[v][1], part[0] == 't' ? 1 : 0);
  }
  EXPECT_EQ(faces_of(mesh, "right", "here").size(), 3u);
}

TEST(Meridian, ARingKeepsAllOfItsBoundary) {
  Mesh<2> mesh = rectangle({0.5, 0}, {2, 1}, {3, 3});
  read_as_meridian(mesh, "here");
  EXPECT_EQ(mesh.boundary.size(), 12u);
  EXPECT_EQ(faces_of(mesh, "left", "here").size(), 3u);
}

TEST(Meridian, NothingLiesBeyondTheAxis) {
  Mesh<2> mesh = rectangle({-0.5, 0}, {2, 1}, {5, 3});
  try {
    read_as_meridian(mesh, "scene.toml:3: plane");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    EXPECT_THAT(error.what(), HasSubstr("scene.toml:3: plane"));
    EXPECT_THAT(error.what(), HasSubstr("(-0.5, "));
  }
}

}  // namespace
}  // namespace signorini
