#pragma once
#include <algorithm>
#include <vector>

#include "core/mortar/side.hpp"

namespace signorini::mortar {

/// The boxes around faces.
template <int D>
struct Boxes {
  std::vector<Point<D>> middle, half;

  explicit Boxes(const mortar::Side<D>& side) {
    middle.reserve(side.corner.size());
    half.reserve(side.corner.size());
    for (const auto& corner : side.corner) {
      Point<D> low = corner[0], high = corner[0], m, h;
      for (const Point<D>& x : corner)
        for (int k = 0; k < D; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
      for (int k = 0; k < D; ++k) {
        m[k] = 0.5 * low[k] + 0.5 * high[k];
        h[k] = std::max(high[k] - m[k], m[k] - low[k]);
      }
      middle.push_back(m);
      half.push_back(h);
    }
  }
};

}  // namespace signorini::mortar
