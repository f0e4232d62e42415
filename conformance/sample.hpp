#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "conformance/random.hpp"
#include "core/sdk/block.hpp"
#include "core/sdk/obstacle.hpp"

namespace signorini::conformance {

/// What checks ask about at one node, in local coordinates.
template <int B>
struct Sample {
  using Vector = std::array<double, B>;

  Vector x{}, z{}, w{};  ///< within the bounds
  Vector step{}, force{};
  std::array<double, B * B> M{};  ///< definite
  Vector lower{}, upper{}, last{};
  std::array<double, most_data> data{}, before{};
  Vector normal{};                ///< of a facet: normal . v <= normal . z
  int width = 0, directions = 0;  ///< how many of the numbers there are; how many directions are bounded
  Flags tangential = 0;
  double size = 1;  ///< of places and steps

  Vector moved(const Vector& from, const Vector& by) const {
    Vector out;
    for (int k = 0; k < B; ++k) out[k] = block::clamp(from[k] + by[k], lower[k], upper[k]);
    return out;
  }
  void put_within_bounds() {
    for (Vector* v : {&x, &z, &w}) *v = moved(*v, {});
  }
};

/// Samples at random vertices, with the numbers that an obstacle gives them. Sizes are 1e-3 to 1, some 1e-12 and 1e12.
template <int B>
std::vector<Sample<B>> samples_of(const Obstacle<B>& obstacle, int count, Random& random);

/// A vertex that obstacles may be asked about.
SurfaceVertex random_vertex(int dimension, Random& random);

/// A sample in words.
/// @param parts which of it: x, z, w, d for the step, M for matrix and force, n for the facet
template <int B>
std::string describe(const Sample<B>& sample, std::string_view parts);

/// Rounded to so many digits.
double rounded_to(double value, int digits);

/// A sample as simple as possible for which `fails(sample)` is true, as it is for the one given.
template <int B, class Fails>
Sample<B> simplest(Sample<B> sample, const Fails& fails) {
  const auto attempt = [&](const auto& change) {
    Sample<B> other = sample;
    change(other);
    other.put_within_bounds();
    if (fails(other)) sample = other;
  };
  attempt([](Sample<B>& s) { s.last = {}; });
  attempt([](Sample<B>& s) { s.before = {}; });
  attempt([](Sample<B>& s) { s.lower.fill(-infinity), s.upper.fill(infinity); });
  for (const int digits : {2, 1}) {
    for (auto part : {&Sample<B>::x, &Sample<B>::z, &Sample<B>::w, &Sample<B>::step, &Sample<B>::force,
                      &Sample<B>::last, &Sample<B>::normal, &Sample<B>::lower, &Sample<B>::upper}) {
      for (int k = 0; k < B; ++k)
        if (part != &Sample<B>::lower && part != &Sample<B>::upper) attempt([&](Sample<B>& s) { (s.*part)[k] = 0; });
      attempt([&](Sample<B>& s) {
        for (double& v : s.*part) v = rounded_to(v, digits);
      });
    }
    attempt([&](Sample<B>& s) {
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) s.M[i * B + j] = i == j ? rounded_to(s.M[i * B + j], digits) : 0;
    });
    attempt([&](Sample<B>& s) {
      for (double& v : s.M) v = rounded_to(v, digits);
    });
  }
  return sample;
}

}  // namespace signorini::conformance
