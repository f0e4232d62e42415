#include "core/geometry/cgal/plane/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/cgal/checks.hpp"
#include "core/geometry/cgal/plane/polygon.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

using std::numbers::pi;

Outline outline_of(const Disk& disk) {
  const char* shape = disk.lower_half ? "half_disk" : "disk";
  require_finite(shape, "center", disk.center);
  require_positive(shape, "radius", disk.radius);
  const Point<2>& c = disk.center;
  const double r = disk.radius;
  const Point<2> left{c[0] - r, c[1]}, right{c[0] + r, c[1]};
  Outline result{shape, {}, Curve<2>{c, r}, 2 * r, r, {}};
  const Point<2> top{c[0], c[1] + r}, bottom{c[0], c[1] - r};
  if (disk.lower_half && disk.right_half)
    result.sides = {{bottom, right, true, "curved"}, {right, c, false, "flat"}, {c, bottom, false, ""}};
  else if (disk.upper_half && disk.right_half)
    result.sides = {{right, top, true, ""}, {top, c, false, ""}, {c, right, false, ""}};
  else if (disk.upper_half)
    result.sides = {{right, left, true, ""}, {left, right, false, ""}};
  else if (disk.right_half)
    result.sides = {{bottom, top, true, ""}, {top, bottom, false, ""}};
  else if (disk.lower_half)
    result.sides = {{left, right, true, "curved"}, {right, left, false, "flat"}};
  else
    result.sides = {{right, right, true, ""}};
  return result;
}

Outline outline_of(const Polygon& polygon) {
  const auto& points = polygon.points;
  Outline result{"polygon", {}, {}, 0, infinity, {}};
  const bool clockwise = check_polygon(points);
  result.narrowest = narrowest_place(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point<2>&a = points[i], &b = points[(i + 1) % points.size()];
    const int number = polygon.edges.empty() ? static_cast<int>(i) : polygon.edges[i];
    result.sides.push_back(
        {clockwise ? b : a, clockwise ? a : b, false, number < 0 ? "" : fmt::format("edge{}", number)});
    result.diameter = std::max(result.diameter, length<2>(difference<2>(a, points[0])));
  }
  if (clockwise) std::reverse(result.sides.begin(), result.sides.end());
  return result;
}

/// A side by arc length.
struct Path {
  const Outline& outline;
  const Side& side;
  double first = 0, sweep = 0, length = 0;  // angles, for arcs

  Path(const Outline& o, const Side& s) : outline(o), side(s) {
    if (side.curved) {
      const Curve<2>& circle = *outline.circle;
      first = std::atan2(side.from[1] - circle.center[1], side.from[0] - circle.center[0]);
      sweep = std::atan2(side.to[1] - circle.center[1], side.to[0] - circle.center[0]) - first;
      if (sweep <= 0) sweep += 2 * pi;
      length = circle.radius * sweep;
    } else {
      length = signorini::length<2>(difference<2>(side.to, side.from));
    }
  }

  Point<2> at(double s) const {
    const double t = std::min(s / length, 1.0);
    if (t == 0) return side.from;
    if (!side.curved) return {std::lerp(side.from[0], side.to[0], t), std::lerp(side.from[1], side.to[1], t)};
    const Point<2>& c = outline.circle->center;
    const double r = outline.circle->radius;
    return {c[0] + r * std::cos(first + t * sweep), c[1] + r * std::sin(first + t * sweep)};
  }
};

}  // namespace

Outline outline(const Shape2& shape) {
  return std::visit([](const auto& s) { return outline_of(s); }, shape);
}

std::vector<Point<2>> divide(const Outline& outline, const Side& side, const Sizing<2>& size) {
  const Path path(outline, side);
  std::vector<double> marks{0};  // one step of the local size apart
  while (marks.back() < path.length) {
    const double h = size(path.at(marks.back()));
    marks.push_back(marks.back() + size(path.at(marks.back() + h / 2)));
  }
  const auto last = static_cast<double>(marks.size() - 1);
  const double steps = last - (marks.back() - path.length) / (marks.back() - marks[marks.size() - 2]);
  const double whole = std::max(1.0, std::round(steps));
  std::vector<Point<2>> points;
  for (double i = 0; i < whole; ++i) {
    const double position = i * steps / whole, below = std::min(std::floor(position), last - 1);
    const auto k = static_cast<std::size_t>(below);
    points.push_back(path.at(std::lerp(marks[k], marks[k + 1], position - below)));
  }
  return points;
}

}  // namespace signorini::geometry
