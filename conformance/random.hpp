#pragma once
#include <array>
#include <cmath>
#include <random>

#include "core/base/types.hpp"

namespace signorini::conformance {

/// Random numbers, the same in every run.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// From low to high, each power of ten as likely.
  double size(double low, double high) { return low * std::pow(high / low, unit()); }
  bool chance(double probability) { return unit() < probability; }

  /// In the cube of this size around zero.
  template <int B>
  std::array<double, B> vector(double size) {
    std::array<double, B> out;
    for (double& v : out) v = size * between(-1, 1);
    return out;
  }
  template <int B>
  std::array<double, B> direction() {
    for (;;) {
      std::array<double, B> out = vector<B>(1);
      double square = 0;
      for (const double v : out) square += v * v;
      if (square > 1 || square < 0.01) continue;
      for (double& v : out) v /= std::sqrt(square);
      return out;
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace signorini::conformance
