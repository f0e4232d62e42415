#pragma once
#include <array>
#include <cstdint>
#include <limits>

namespace signorini {

using Index = std::int32_t;   ///< numbers of vectors, vertices, elements, columns
using Offset = std::int64_t;  ///< positions among the nonzeros of a matrix
using Flags = std::uint8_t;   ///< one bit per component of a vector

inline constexpr double infinity = std::numeric_limits<double>::infinity();

template <int D>
using Point = std::array<double, D>;

}  // namespace signorini
