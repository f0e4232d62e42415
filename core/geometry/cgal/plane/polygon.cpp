#include "core/geometry/cgal/plane/polygon.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geometry/cgal/checks.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

ShapeError error(const std::string& complaint) { return {"polygon", "points", complaint}; }

void require_distinct(const std::vector<Point<2>>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return points[i] != points[j] ? points[i] < points[j] : i < j; });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (points[order[k - 1]] == points[order[k]])
      throw error(fmt::format("points[{}] and points[{}] are the same, [{:g}]; expected distinct points", order[k - 1],
                              order[k], fmt::join(points[order[k]], ", ")));
}

struct Segment {
  Point<2> a, b;

  double distance(const Point<2>& p) const {
    const Point<2> along = difference<2>(b, a), to = difference<2>(p, a);
    const double t = (along[0] * to[0] + along[1] * to[1]) / (along[0] * along[0] + along[1] * along[1]);
    const double s = std::clamp(t, 0.0, 1.0);
    return length<2>({to[0] - s * along[0], to[1] - s * along[1]});
  }
};

[[noreturn]] void report_crossing(const CGAL::Polygon_2<Kernel>& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const auto a = polygon.edge(i), b = polygon.edge(j);
      const bool next = j == i + 1, previous = (j + 1) % n == i;
      // Neighbours share an end; they overlap where the other end of one lies on the other.
      const bool meet = next       ? a.has_on(b.target()) || b.has_on(a.source())
                        : previous ? a.has_on(b.source()) || b.has_on(a.target())
                                   : CGAL::do_intersect(a, b);
      if (meet)
        throw error(fmt::format("edge{} and edge{} meet or cross; expected sides that meet at their ends only", i, j));
    }
  throw error("sides cross; expected sides that meet at their ends only");
}

}  // namespace

bool check_polygon(const std::vector<Point<2>>& points) {
  if (points.size() < 3) throw error(fmt::format("found {}, expected at least 3", points.size()));
  CGAL::Polygon_2<Kernel> polygon;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i][0]) || !std::isfinite(points[i][1]))
      throw error(fmt::format("points[{}]: found [{:g}], expected finite numbers", i, fmt::join(points[i], ", ")));
    polygon.push_back({points[i][0], points[i][1]});
  }
  require_distinct(points);
  if (std::all_of(points.begin() + 2, points.end(), [&](const Point<2>& p) {
        return CGAL::collinear(polygon[0], polygon[1], Kernel::Point_2(p[0], p[1]));
      }))
    throw error("all lie on one line; expected an area");
  if (!polygon.is_simple()) report_crossing(polygon);
  return polygon.is_clockwise_oriented();
}

std::string narrowest_place(const std::vector<Point<2>>& points) {
  const std::size_t n = points.size();
  if (n > 2000) return {};
  double least = infinity;
  std::string place;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 2; k < n; ++k) {  // the corners that do not end the side
      const std::size_t corner = (i + k) % n;
      const double width = Segment{points[i], points[(i + 1) % n]}.distance(points[corner]);
      if (width >= least) continue;
      least = width;
      place = fmt::format("points[{}] is {:.3g} away from edge{}", corner, width, i);
    }
  return place;
}

}  // namespace signorini::geometry
