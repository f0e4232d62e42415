#pragma once
#include <cmath>
#include <vector>

#include "core/sdk/polyhedron.hpp"
#include "tests/support/random.hpp"

/// Random facets at single vectors: dependent, nearly parallel and degenerate ones as well.
namespace signorini::test {

/// Facets that leave the point z admissible: of no special kind, equal or nearly parallel to one before, through one
/// point, slabs, and such that are met everywhere.
/// @param angle between nearly parallel ones, at least: a power of ten
template <int B>
std::vector<Facet<B>> random_facets(Random& random, int count, const double* z, double angle = -9) {
  std::vector<Facet<B>> out;
  const bool through_one_point = random.chance(0.3);
  for (int k = 0; k < count; ++k) {
    Facet<B> f{{}, -infinity, infinity, 1e-13};
    for (double& c : f.normal) c = random.between(-1, 1);
    if (k > 0 && random.chance(0.4)) {
      const Facet<B>& other = out[static_cast<std::size_t>(random.below(k))];
      const double apart = random.chance(0.3) ? 0 : std::pow(10.0, random.between(angle, -1));
      const double sign = random.chance(0.7) ? 1 : -1;
      for (int i = 0; i < B; ++i) f.normal[i] = sign * other.normal[i] + apart * random.between(-1, 1);
    }
    double at = 0;
    for (int i = 0; i < B; ++i) at += f.normal[i] * z[i];
    const double room = through_one_point ? 0 : random.between(0, 0.5);
    f.lower = at - room;
    if (random.chance(0.2)) f.upper = at + (random.chance(0.3) ? 0 : random.between(0, 0.5));
    if (random.chance(0.3)) {
      std::swap(f.lower, f.upper);
      f.lower = f.lower == infinity ? -infinity : 2 * at - f.lower;
      f.upper = 2 * at - f.upper;
    }
    out.push_back(f);
  }
  return out;
}

}  // namespace signorini::test
