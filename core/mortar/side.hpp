#pragma once
#include <vector>

#include "core/mortar/couple.hpp"

namespace signorini::mortar {

/// A surface made ready: checked, its nodes numbered among themselves, its faces one after the other in memory.
template <int D>
struct Side {
  /// Error(Exit::input) as couple() says.
  explicit Side(const SurfaceFaces<D>& surface);

  std::span<const std::array<Index, D>> faces;
  std::vector<Index> node;                      ///< the points that are nodes of it, ascending
  std::vector<Index> number;                    ///< per point its place among them, or -1
  std::vector<std::array<Point<D>, D>> corner;  ///< per face
  std::vector<Point<D>> normal;                 ///< of length 1, outwards
  std::vector<double> area;
};

}  // namespace signorini::mortar
