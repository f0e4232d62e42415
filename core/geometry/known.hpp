#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/types.hpp"

namespace signorini::geometry {

/// What is known of flat faces beside their vertices.
template <int D>
struct Known {
  /// Of second-order files, per face; else empty.
  std::vector<std::uint8_t> curved;
  std::vector<std::array<Point<D>, D*(D - 1) / 2>>
      middle;  ///< nodes of its edges, opposite to its corners (D = 2: one)
  std::vector<std::array<Point<D>, D>>
      normal;  ///< per tip: unit normal where it meets a neighbour in all corners but it

  std::vector<Index> name;  ///< per face a number, which others have if they are of the same named parts; or empty
  double fit = 0;           ///< how far vertices may be off a shape, of the size of a part; 0: by rounding alone

  bool second_order() const { return !curved.empty(); }
};

}  // namespace signorini::geometry
