#pragma once
#include <array>
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// How a force divides among obstacles that push along given directions.
struct ForceSplit {
  std::vector<double> part;   ///< per direction, not negative
  std::vector<char> unknown;  ///< per direction: other parts would do as well
};

/// Parts whose sum along the unit directions is next to the force. Where there are several ways to divide it, the mean
/// of all those that take independent directions only.
template <int B>
ForceSplit split_force(const std::vector<std::array<double, B>>& directions, const std::array<double, B>& force);

}  // namespace signorini
