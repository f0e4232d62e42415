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
    shown.pressure.push_back(touches ? 1 : 0);                // on both sides
    if (touches && v >= 36) shown.reached.push_back({v, 0});  // those of the upper block
  }
  Warnings notes;
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

/// A unit square that obstacles 3 and 5 press on from below and from the right, not in its corner.
class Profiles : public testing::Test {
 protected:
  Profiles() {
    hierarchy_.levels.push_back(rectangle({0, 0}, {1, 1}, {4, 4}));
    const Mesh<2>& mesh = hierarchy_.finest();
    shown_.value = shown_.pressure = std::vector<double>(mesh.points.size());
    shown_.displacement.resize(2 * mesh.points.size());
    shown_.tangential.resize(3 * mesh.points.size());
    shown_.contact.assign(mesh.points.size(), 0);
    for (Index v = 0; v < mesh.vertices(); ++v)
      if (mesh.points[v][1] == 0) press(v, 3, mesh.points[v][0], 2);
    for (Index v = 0; v < mesh.vertices(); ++v)
      if (mesh.points[v][0] == 1) press(v, 5, mesh.points[v][1], 3);
  }

  /// By that much at a place along a side, but for the ends of it.
  void press(Index v, int obstacle, double place, Flags state) {
    shown_.reached.push_back({v, obstacle});
    if (place == 0 || place == 1) return;
    shown_.pressure[v] = obstacle;
    shown_.tangential[3 * std::size_t(v) + (obstacle == 3 ? 0 : 1)] = 0.1 * obstacle;
    shown_.contact[v] = state;
  }

  std::vector<Panel> panels() {
    Warnings notes;
    return elastic_panels(shown_, notes);
  }

  MeshHierarchy<2> hierarchy_;
  Shown<2> shown_{hierarchy_, {}, {}, "", {}, {}, {}, {}, false};
};

TEST_F(Profiles, AreLinesOfTheirOwnFromTheMiddleOfEachContact) {
  const auto all = panels();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].across, "place along the contact, from its middle");
  ASSERT_EQ(all[1].lines.size(), 2u);
  const int obstacles[] = {3, 5};
  for (std::size_t k = 0; k < 2; ++k) {
    const Line& line = all[1].lines[k];
    EXPECT_EQ(line.name, "obstacle " + std::to_string(obstacles[k]));
    ASSERT_EQ(line.points.size(), 3u) << "as far as 1.5 times its size";
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(line.points[i][0], 0.25 * (static_cast<double>(i) - 1), 1e-12);
      EXPECT_EQ(line.points[i][1], obstacles[k]);
    }
  }
}

// Marks of the lines themselves would cover those of friction.
TEST_F(Profiles, OfFrictionHaveMarksWhereItSlipsAndSticks) {
  const Panel friction = panels().at(2);
  EXPECT_EQ(friction.across, "place along the contact, from its middle");
  ASSERT_EQ(friction.lines.size(), 4u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_TRUE(friction.lines[k].joined && !friction.lines[k].marked);
  const char* const names[] = {"slip", "stick"};
  for (std::size_t k = 0; k < 2; ++k) {
    const Line& marks = friction.lines[k + 2];
    EXPECT_EQ(marks.name, names[k]);
    EXPECT_FALSE(marks.joined);
    ASSERT_EQ(marks.points.size(), 3u);
    EXPECT_EQ(marks.points, friction.lines[k].points);
    for (std::size_t other = 0; other < 2; ++other) EXPECT_NE(marks.style, friction.lines[other].style);
  }
  EXPECT_NEAR(std::abs(friction.lines[0].points[1][1]), 0.3, 1e-12);
  EXPECT_NEAR(std::abs(friction.lines[1].points[1][1]), 0.5, 1e-12);
}

TEST_F(Profiles, OfOneObstacleHaveNoName) {
  std::erase_if(shown_.reached, [](const Reached& r) { return r.obstacle == 5; });
  const auto all = panels();
  ASSERT_EQ(all.at(1).lines.size(), 1u);
  EXPECT_EQ(all[1].lines[0].name, "");
}

}  // namespace
}  // namespace signorini
