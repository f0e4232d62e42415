#include "apps/signorini/slice.hpp"

#include "core/base/dot.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

/// A vertex: its height above the plane, its place in it, and its value.
struct Corner {
  double height;
  std::array<double, 3> at;
};

/// Where the plane meets the edge from a to b.
std::array<double, 3> crossing(const Corner& a, const Corner& b) {
  const double s = a.height / (a.height - b.height);
  std::array<double, 3> out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = a.at[k] + s * (b.at[k] - a.at[k]);
  return out;
}

Patch triangle(const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c) {
  return {{{a[0], a[1], 0}, {b[0], b[1], 0}, {c[0], c[1], 0}}, {a[2], b[2], c[2]}};
}

}  // namespace

std::vector<Patch> slice(std::span<const std::array<Index, 4>> elements, std::span<const Point<3>> points,
                         std::span<const double> value, const Section& section) {
  const Point<3> normal = cross(section.right, section.up);
  const auto corner = [&](Index v) -> Corner {
    const Point<3> d = difference<3>(points[v], section.through);
    return {dot(d, normal), {dot(d, section.right), dot(d, section.up), value[v]}};
  };
  std::vector<Patch> patches;
  for (const auto& element : elements) {
    std::array<Corner, 4> below, above;
    std::size_t lower = 0, upper = 0;
    for (const Index v : element) {
      const Corner c = corner(v);
      (c.height < 0 ? below[lower++] : above[upper++]) = c;
    }
    const auto cut = [&](std::size_t i, std::size_t j) { return crossing(below[i], above[j]); };
    if (lower == 1) patches.push_back(triangle(cut(0, 0), cut(0, 1), cut(0, 2)));
    if (upper == 1) patches.push_back(triangle(cut(0, 0), cut(1, 0), cut(2, 0)));
    if (lower != 2) continue;
    patches.push_back(triangle(cut(0, 0), cut(0, 1), cut(1, 1)));
    patches.push_back(triangle(cut(0, 0), cut(1, 1), cut(1, 0)));
  }
  return patches;
}

}  // namespace signorini
