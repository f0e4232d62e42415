#include "core/geometry/cgal/polygon.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>

#include <algorithm>
#include <numeric>

#include "core/geometry/cgal/checks.hpp"

namespace signorini::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
constexpr const char* shape = "polygon";

void require_distinct(const std::vector<Point<2>>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return points[i] != points[j] ? points[i] < points[j] : i < j; });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (points[order[k - 1]] == points[order[k]])
      input_error(shape, fmt::format("points[{}] and points[{}] are the same, [{:g}]; expected distinct points",
                                     order[k - 1], order[k], fmt::join(points[order[k]], ", ")));
}

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
        input_error(shape,
                    fmt::format("points: edge{} and edge{} meet or cross; expected sides that meet at their ends "
                                "only",
                                i, j));
    }
  input_error(shape, "points: sides cross; expected sides that meet at their ends only");
}

}  // namespace

bool check_polygon(const std::vector<Point<2>>& points) {
  if (points.size() < 3) input_error(shape, fmt::format("points: found {}, expected at least 3", points.size()));
  CGAL::Polygon_2<Kernel> polygon;
  for (std::size_t i = 0; i < points.size(); ++i) {
    require_finite(shape, fmt::format("points[{}]", i), points[i]);
    polygon.push_back({points[i][0], points[i][1]});
  }
  require_distinct(points);
  if (std::all_of(points.begin() + 2, points.end(), [&](const Point<2>& p) {
        return CGAL::collinear(polygon[0], polygon[1], Kernel::Point_2(p[0], p[1]));
      }))
    input_error(shape, "points: all lie on one line; expected an area");
  if (!polygon.is_simple()) report_crossing(polygon);
  return polygon.is_clockwise_oriented();
}

}  // namespace signorini::geometry
