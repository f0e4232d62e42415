#pragma once
#include <vector>

#include "core/fem/elements/across.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/mesh/mirror.hpp"

/// Moments of forces at points, with those of the images of both beyond planes of symmetry: three entries in space, in
/// the plane that about the z-axis alone.
namespace signorini {

template <int D>
constexpr std::size_t moment_entries = D == 2 ? 1 : 3;

/// Adds the moment of a force at x about a point.
/// @param across the planes that what exerts it goes on beyond
template <int D>
void add_moment(const std::vector<Mirror>& mirrors, Planes across, const Point<D>& x,
                const std::array<double, D>& force, const std::vector<double>& about, std::vector<double>& moment) {
  for (Planes image = 0; image < 1u << mirrors.size(); ++image) {
    if ((image & across) != image) continue;
    Point<D> r = x;
    std::array<double, D> f = force;
    for (std::size_t m = 0; m < mirrors.size(); ++m) {
      if (!(image >> m & 1u)) continue;
      r = reflected<D>(mirrors[m], r);
      f[mirrors[m].axis] *= -1;
    }
    for (int i = 0; i < D; ++i) r[i] -= about[i];
    moment.back() += r[0] * f[1] - r[1] * f[0];
    if constexpr (D == 3) {
      moment[0] += r[1] * f[2] - r[2] * f[1];
      moment[1] += r[2] * f[0] - r[0] * f[2];
    }
  }
}

}  // namespace signorini
