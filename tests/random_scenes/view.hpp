#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <string>

#include "core/base/types.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {

/// How a scene is written down: its units, where it is and how it is turned. What is solved does not depend on it.
template <int D>
struct View {
  double length = 1, stress = 1;
  std::array<Point<D>, D> axes = unit_axes();  ///< images of the axes
  Point<D> origin{};                           ///< in the scene's own units

  static std::array<Point<D>, D> unit_axes() {
    std::array<Point<D>, D> out{};
    for (int i = 0; i < D; ++i) out[i][i] = 1;
    return out;
  }
  /// A turn about no special axis, through no special point, of the scene or its image in a mirror.
  static View turned(Random& random) {
    View out;
    if (random.chance(0.5)) out.axes[0][0] = -1;
    for (int i = 0; i < D; ++i)
      for (int j = i + 1; j < D; ++j) {
        const double angle = random.between(-3, 3), c = std::cos(angle), s = std::sin(angle);
        for (Point<D>& a : out.axes) {
          const double x = a[i], y = a[j];
          a[i] = c * x - s * y, a[j] = s * x + c * y;
        }
      }
    for (double& x : out.origin) x = random.between(-2, 2);
    return out;
  }

  bool is_plain() const { return axes == unit_axes() && origin == Point<D>{}; }

  Point<D> direction(const Point<D>& d) const {
    Point<D> out{};
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k) out[k] += d[i] * axes[i][k];
    return out;
  }
  Point<D> way(const Point<D>& d) const { return scaled(length, direction(d)); }
  Point<D> place(Point<D> x) const {
    x = way(x);
    for (int k = 0; k < D; ++k) x[k] += length * origin[k];
    return x;
  }
  double force() const { return stress * std::pow(length, D - 1); }

  /// A force that was reported, as the scene has it.
  Point<D> own_force(const Point<D>& f) const {
    Point<D> out{};
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k) out[i] += f[k] * axes[i][k] / force();
    return out;
  }

  static Point<D> scaled(double by, Point<D> x) {
    for (double& c : x) c *= by;
    return x;
  }
};

/// As TOML has it, to the last digit.
template <std::size_t N>
std::string vector_text(const std::array<double, N>& x) {
  return fmt::format("[{:.17g}]", fmt::join(x, ", "));
}

}  // namespace signorini::test
