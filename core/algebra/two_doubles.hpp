#pragma once
#include <cmath>

namespace signorini {

/// The sum of two numbers, the second of which is what the first one rounds away: 106 bits (Dekker, Numer. Math. 18,
/// 1971).
struct TwoDoubles {
  double high = 0, low = 0;

  TwoDoubles() = default;
  explicit TwoDoubles(double value) : high(value) {}

  void add(double value) {
    const double sum = high + value, part = sum - high;
    low += (high - (sum - part)) + (value - part);
    high = sum;
  }
  void add(long double value) {
    const auto rounded = static_cast<double>(value);
    add(rounded);
    low += static_cast<double>(value - rounded);
    normalise();
  }
  /// Adds factor * x; to be normalised after the last one.
  void add_product(double factor, const TwoDoubles& x) {
    const double product = factor * x.high;
    low += std::fma(factor, x.high, -product) + factor * x.low;
    add(product);
  }
  void normalise() {
    const double rest = low;
    low = 0;
    add(rest);
  }
  long double value() const { return static_cast<long double>(high) + low; }
};

}  // namespace signorini
