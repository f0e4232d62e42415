#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace signorini {

/// A PNG file (W3C Recommendation, 2nd edition) of 8 bits per colour.
/// @param pixels row by row from the top, each 0x00RRGGBB; width * height of them
std::string png(std::span<const std::uint32_t> pixels, int width, int height);

}  // namespace signorini
