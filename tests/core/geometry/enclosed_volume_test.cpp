#include "core/geometry/enclosed_volume.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

/// The six sides of a cube, each with points of its own.
void add_cube(double from, double to, PolygonSoup& out) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double at : {from, to}) {
      std::vector<std::size_t> face;
      for (const auto& [a, b] : {std::pair(from, from), std::pair(to, from), std::pair(to, to), std::pair(from, to)}) {
        Point<3> p;
        p[axis] = at, p[(axis + 1) % 3] = a, p[(axis + 2) % 3] = b;
        face.push_back(out.points.size());
        out.points.push_back(p);
      }
      out.faces.push_back(face);  // opposite sides run round the same way
    }
}

TEST(EnclosedVolume, DoesNotDependOnHowFacesAreOriented) {
  PolygonSoup cube;
  add_cube(1, 3, cube);
  EXPECT_NEAR(geometry::enclosed_volume(cube), 8, 1e-14);
  std::ranges::reverse(cube.faces[2]);
  EXPECT_NEAR(geometry::enclosed_volume(cube), 8, 1e-14);
}

TEST(EnclosedVolume, LeavesOutCavities) {
  PolygonSoup hollow;
  add_cube(1.5, 2.5, hollow);
  add_cube(1, 3, hollow);
  EXPECT_NEAR(geometry::enclosed_volume(hollow), 7, 1e-14);
}

TEST(EnclosedVolume, IsNoneOfWhatIsOpen) {
  PolygonSoup open;
  add_cube(0, 1, open);
  open.faces.pop_back();
  EXPECT_TRUE(std::isnan(geometry::enclosed_volume(open)));
}

}  // namespace
}  // namespace signorini
