#pragma once
#include <cmath>

#include "core/base/types.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

inline double norm(const Point<3>& a) { return std::hypot(a[0], a[1], a[2]); }

template <std::size_t D>
std::array<double, D> scaled(double s, std::array<double, D> a) {
  for (double& x : a) x *= s;
  return a;
}

/// a + s b
template <std::size_t D>
std::array<double, D> plus(std::array<double, D> a, double s, const std::array<double, D>& b) {
  for (std::size_t k = 0; k < D; ++k) a[k] += s * b[k];
  return a;
}

template <std::size_t D>
std::array<double, D> minus(const std::array<double, D>& a, const std::array<double, D>& b) {
  return plus<D>(a, -1, b);
}

/// a / |a|, or zero where a is zero.
template <std::size_t D>
std::array<double, D> unit(const std::array<double, D>& a) {
  const double l = length<static_cast<int>(D)>(a);
  return l > 0 ? scaled<D>(1 / l, a) : std::array<double, D>{};
}

}  // namespace signorini::geometry
