#pragma once
#include <vector>

namespace signorini {

/// a'b of vectors of the same length.
inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) s += a[i] * b[i];
  return s;
}

}  // namespace signorini
