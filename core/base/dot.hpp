#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace signorini {

/// a'b of vectors of the same length.
inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) s += a[i] * b[i];
  return s;
}

/// The largest |v_i|; zero where there is none. Entries that are no numbers do not count.
inline double max_norm(std::span<const double> v) {
  double out = 0;
  for (const double value : v) out = std::max(out, std::abs(value));
  return out;
}

template <std::size_t N>
double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double s = 0;
  for (std::size_t i = 0; i < N; ++i) s += a[i] * b[i];
  return s;
}

/// Scales a vector to length one and returns its former length; the zero vector stays.
template <std::size_t N>
inline double normalise(std::array<double, N>& v) {
  const double length = std::sqrt(dot(v, v));
  if (length > 0)
    for (double& c : v) c /= length;
  return length;
}

inline std::array<double, 3> cross(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace signorini
