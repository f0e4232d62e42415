#pragma once
#include <array>
#include <string>

#include "core/io/picture.hpp"

namespace signorini {

/// Colours from low to high values, at equal distances: red, green, blue from 0 to 255.
inline constexpr std::array<std::array<int, 3>, 9> palette{{{0x30, 0x12, 0x3b},
                                                            {0x46, 0x69, 0xdb},
                                                            {0x26, 0xbc, 0xe1},
                                                            {0x3f, 0xf5, 0x8a},
                                                            {0xa4, 0xfc, 0x3c},
                                                            {0xec, 0xd0, 0x3a},
                                                            {0xfb, 0x7e, 0x21},
                                                            {0xd0, 0x2f, 0x05},
                                                            {0x7a, 0x04, 0x03}}};

/// Interpolated.
/// @param part 0 for the lowest values, 1 for the highest
std::array<int, 3> colour(double part);

/// The values at the ends of the palette.
struct ColourRange {
  double low = 0, high = 1;
};

/// The least range that holds the values of all patches; widened where they are equal.
ColourRange colour_range(const std::vector<Patch>& patches);

/// Pixels of three bytes, red, green and blue, row by row from the bottom.
struct Raster {
  int width = 0, height = 0;
  std::string rgb;
};

/// The patches of a panel as seen in its view, the nearest ones before the others, in true proportions and as large as
/// fits into a square of `size` pixels. Values are interpolated within a patch. The cost is that of the patches and the
/// pixels, so that patches smaller than a pixel are a waste.
Raster draw_patches(const Panel& panel, const ColourRange& range, int size);

}  // namespace signorini
