#pragma once
#include <algorithm>
#include <cmath>

#include "core/base/rounding.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// What is left of a length between vertices of a mesh that ought to be zero.
template <int D>
double rounding_of_places(const Mesh<D>& mesh) {
  double largest = 0;
  for (const Point<D>& x : mesh.points)
    for (const double coordinate : x) largest = std::max(largest, std::fabs(coordinate));
  return rounding_of_differences * largest;
}

}  // namespace signorini
