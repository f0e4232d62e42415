#include "core/io/raster.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace signorini {
namespace {

using Pixel = std::array<int, 3>;

Pixel at(const Raster& raster, int column, int row) {
  Pixel pixel;
  for (int k = 0; k < 3; ++k)
    pixel[k] = static_cast<unsigned char>(raster.rgb[3 * (std::size_t(row) * raster.width + column) + k]);
  return pixel;
}

/// [0, width] x [0, 1] in n x n cells of two triangles, at height z, with value x.
Panel plate(double width, double z, int n) {
  Panel panel;
  const auto corner = [&](int i, int j) { return std::array<double, 3>{width * i / n, double(j) / n, z}; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (const auto& triangle : {std::array{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)},
                                   std::array{corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)}}) {
        Patch& patch = panel.patches.emplace_back();
        for (int c = 0; c < 3; ++c) {
          std::copy(triangle[c].begin(), triangle[c].end(), patch.corner[c]);
          patch.value[c] = triangle[c][0];
        }
      }
  return panel;
}

TEST(Raster, CoversAPlateInItsProportionsWithoutHoles) {
  const Panel panel = plate(2, 0, 80);  // so fine that edges are left out
  const Raster raster = draw_patches(panel, colour_range(panel.patches), 100);
  ASSERT_EQ(raster.width, 100);
  ASSERT_EQ(raster.height, 50);
  for (int row = 0; row < 50; ++row)
    for (int column = 0; column < 100; ++column) {
      const double place = 8 * (column + 0.5) / 100;  // along the palette
      const int below = static_cast<int>(place);
      for (int k = 0; k < 3; ++k) {
        const double colour = palette[below][k] + (place - below) * (palette[below + 1][k] - palette[below][k]);
        ASSERT_NEAR(at(raster, column, row)[k], colour, 1.0) << row << ' ' << column;
      }
    }
}

TEST(Raster, FewPatchesHaveEdges) {
  const Panel panel = plate(1, 0, 1);
  const Raster raster = draw_patches(panel, {0, 1}, 101);
  EXPECT_EQ(at(raster, 50, 50), (Pixel{0x60, 0x60, 0x60})) << "the diagonal";
  EXPECT_NE(at(raster, 70, 30), (Pixel{0x60, 0x60, 0x60}));
}

TEST(Raster, WhatIsNearerHidesTheRestInAnyOrder) {
  Panel both = plate(1, 0, 80);
  Panel near = plate(0.5, 1, 80);
  for (Patch& patch : near.patches)
    for (double& value : patch.value) value = 5;
  both.view = View::space;
  both.from[0] = both.from[1] = 0;
  both.from[2] = 1;
  both.patches.insert(both.patches.end(), near.patches.begin(), near.patches.end());
  const Raster one = draw_patches(both, {0, 5}, 60);
  std::reverse(both.patches.begin(), both.patches.end());
  EXPECT_EQ(one.rgb, draw_patches(both, {0, 5}, 60).rgb);
  EXPECT_GT(at(one, 10, 30)[0], at(one, 10, 30)[2]) << "red, of high values";
  EXPECT_LT(at(one, 50, 30)[0], at(one, 50, 30)[2]);
}

TEST(Raster, WhatIsNoNumberIsNotDrawn) {
  Panel panel = plate(1, 0, 80);
  const Raster whole = draw_patches(panel, {0, 1}, 40);
  for (const double broken : {std::nan(""), infinity}) {
    Patch patch = panel.patches.front();
    patch.value[1] = std::nan("");
    panel.patches.push_back(patch);
    patch = panel.patches.front();
    patch.corner[1][2] = broken * 0;
    panel.patches.push_back(patch);
  }
  EXPECT_EQ(draw_patches(panel, {0, 1}, 40).rgb, whole.rgb);
}

TEST(Raster, EqualValuesHaveARangeThatIsNotEmpty) {
  for (const double value : {0.0, 3.0, -1e-9}) {
    Panel panel = plate(1, 0, 1);
    for (Patch& patch : panel.patches) std::fill_n(patch.value, 3, value);
    const ColourRange range = colour_range(panel.patches);
    EXPECT_LT(range.low, value);
    EXPECT_GT(range.high, value);
  }
}

}  // namespace
}  // namespace signorini
