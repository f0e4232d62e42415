#include "core/geometry/tips.hpp"

#include <cmath>
#include <numbers>

#include "core/base/dot.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

constexpr double around_tip = 0.25;  // of the curvature at a tip: more beside it is no tip's

}  // namespace

std::vector<std::uint8_t> find_tips(std::span<const Point<3>> points, const std::vector<std::array<Index, 3>>& faces,
                                    const Joints<3>& joints, const std::vector<std::uint8_t>& sharp, double crease) {
  std::vector<double> missing(points.size(), 2 * std::numbers::pi), area(points.size(), 0);
  std::vector<std::uint8_t> smooth(points.size(), 1);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = faces[f][k], next = faces[f][(k + 1) % 3], last = faces[f][(k + 2) % 3];
      const Point<3> a = difference<3>(points[next], points[v]), b = difference<3>(points[last], points[v]);
      const double size = length<3>(cross(a, b));
      missing[v] -= std::atan2(size, dot(a, b));
      area[v] += size;
      if (sharp[joints.number[3 * f + k]] != 0 || joints.beyond[3 * f + k] < 0) smooth[next] = smooth[last] = 0;
    }
  const double most = 2 * std::numbers::pi * (1 - std::cos(crease / 2));
  std::vector<std::uint8_t> tip(points.size());
  for (std::size_t v = 0; v < tip.size(); ++v) tip[v] = smooth[v] != 0 && std::abs(missing[v]) > most;
  const auto curvature = [&](Index v) { return std::abs(missing[v]) / area[v]; };
  for (const auto& face : faces)
    for (const Index v : face)
      for (const Index other : face)
        if (v != other && smooth[other] != 0 && curvature(other) > around_tip * curvature(v)) tip[v] = 0;
  return tip;
}

}  // namespace signorini::geometry
