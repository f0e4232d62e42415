#pragma once
#include <random>
#include <vector>

namespace signorini {

/// Numbers in (-1/2, 1/2), always the same: two matrices that do the same to such a vector are one, but for rounding.
inline std::vector<double> random_vector(std::size_t size) {
  std::vector<double> out(size);
  std::minstd_rand random;
  for (double& value : out) value = static_cast<double>(random()) / std::minstd_rand::max() - 0.5;
  return out;
}

}  // namespace signorini
