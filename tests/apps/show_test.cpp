#include "apps/signorini/show.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/join.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/structured.hpp"

namespace signorini {
namespace {

/// The unit cube and a block on it, of half its height.
MeshHierarchy<3> two_blocks() {
  MeshHierarchy<3> out;
  out.levels.push_back(join<3>({box({0, 0, 0}, {1, 1, 1}, {2, 3, 2}), box({0, 0, 1}, {1, 1, 1.5}, {3, 2, 3})},
                               {"lower", "upper"}, {0, 0}));
  return out;
}

double area(const Patch& patch) {
  const auto& c = patch.corner;
  return std::abs((c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[2][0] - c[0][0]) * (c[1][1] - c[0][1])) / 2;
}

// Coloured by the height, which the section shows upright: both blocks are seen, whole, and everything in its place.
TEST(Picture, CutsBodiesOpenThatTouchEachOther) {
  const MeshHierarchy<3> hierarchy = two_blocks();
  const Mesh<3>& mesh = hierarchy.finest();
  Shown<3> shown{hierarchy, std::vector<double>(3 * mesh.points.size()), {}, "height", {}, {}, {}, {}, true};
  shown.contact.assign(mesh.points.size(), 0);
  for (Index v = 0; v < mesh.vertices(); ++v) {
    shown.value.push_back(mesh.points[v][2]);
    const auto& [x, y, z] = mesh.points[v];
    const bool touches = z == 1 && x > 0 && x < 1 && y > 0 && y < 1;
    shown.pressure.push_back(touches ? 1 : 0);           // on both sides
    if (touches && v >= 36) shown.touched.push_back(v);  // those of the upper block
  }
  std::vector<std::string> notes;
  const std::vector<Panel> panels = elastic_panels(shown, notes);
  EXPECT_TRUE(notes.empty());
  const auto cut = std::ranges::find(panels, "deformed bodies, cut open", &Panel::title);
  ASSERT_NE(cut, panels.end());
  EXPECT_EQ(cut->view, View::flat);
  double total = 0;
  for (const Patch& patch : cut->patches) {
    total += area(patch);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(patch.corner[c][1] + 1, patch.value[c], 1e-12);
  }
  EXPECT_NEAR(total, 1.5, 1e-12);
  EXPECT_NE(std::ranges::find(panels, "contact pressure", &Panel::title), panels.end());
  shown.two_bodies = false;
  const std::vector<Panel> without = elastic_panels(shown, notes);
  EXPECT_EQ(without.size() + 1, panels.size());
}

}  // namespace
}  // namespace signorini
