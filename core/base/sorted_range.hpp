#pragma once
#include <algorithm>
#include <span>

namespace signorini {

/// Of what lies one after the other in memory, ascending by a projection, the part where that is a value.
/// As std::ranges::equal_range, which clang 14 cannot compile with the library of GCC 12.
template <class Sorted, class T, class Projection>
auto part_with(Sorted& sorted, const T& value, Projection projection) {
  const auto first = std::ranges::lower_bound(sorted, value, {}, projection);
  return std::span(first, std::ranges::upper_bound(first, sorted.end(), value, {}, projection));
}

}  // namespace signorini
