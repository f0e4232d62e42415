#include "apps/signorini/slice.hpp"

#include <array>

namespace signorini {
namespace {

/// x, z and value where the plane meets the edge from a to b.
std::array<double, 3> crossing(const Mesh<3>& mesh, std::span<const double> value, Index a, Index b, double at) {
  const Point<3>&p = mesh.points[a], &q = mesh.points[b];
  const double s = (at - p[1]) / (q[1] - p[1]);
  return {p[0] + s * (q[0] - p[0]), p[2] + s * (q[2] - p[2]), value[a] + s * (value[b] - value[a])};
}

Patch triangle(const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c) {
  return {{{a[0], a[1], 0}, {b[0], b[1], 0}, {c[0], c[1], 0}}, {a[2], b[2], c[2]}};
}
}  // namespace

std::vector<Patch> slice(const Mesh<3>& mesh, std::span<const double> value, double at) {
  std::vector<Patch> patches;
  for (const auto& element : mesh.elements) {
    std::array<Index, 4> below{}, above{};
    int lower = 0, upper = 0;
    for (const Index v : element) (mesh.points[v][1] < at ? below[lower++] : above[upper++]) = v;
    const auto cut = [&](int i, int j) { return crossing(mesh, value, below[i], above[j], at); };
    if (lower == 1) patches.push_back(triangle(cut(0, 0), cut(0, 1), cut(0, 2)));
    if (upper == 1) patches.push_back(triangle(cut(0, 0), cut(1, 0), cut(2, 0)));
    if (lower != 2) continue;
    patches.push_back(triangle(cut(0, 0), cut(0, 1), cut(1, 1)));
    patches.push_back(triangle(cut(0, 0), cut(1, 1), cut(1, 0)));
  }
  return patches;
}

}  // namespace signorini
