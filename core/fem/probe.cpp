#include "core/fem/probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

#include "core/base/error.hpp"
#include "core/fem/element.hpp"

namespace signorini {
namespace {

constexpr double rounding = 1e-12;

template <int D>
bool in_bounding_box(const Mesh<D>& mesh, const Simplex<D>& vertices, const Point<D>& x) {
  for (int i = 0; i < D; ++i) {
    double low = infinity, high = -infinity;
    for (const Index p : vertices) {
      low = std::min(low, mesh.points[p][i]);
      high = std::max(high, mesh.points[p][i]);
    }
    const double slack = rounding * (high - low);
    if (x[i] < low - slack || x[i] > high + slack) return false;
  }
  return true;
}

template <int D>
std::array<double, D + 1> barycentric(const Mesh<D>& mesh, const Simplex<D>& vertices, const Point<D>& x) {
  const LinearElement<D> element = linear_element(mesh, vertices);
  const Point<D> d = difference<D>(x, mesh.points[vertices[0]]);
  std::array<double, D + 1> out;
  for (int a = 0; a <= D; ++a) out[a] = (a == 0 ? 1 : 0) + dot(element.gradient[a], d);
  return out;
}

template <int D>
std::optional<Place<D>> containing(const Mesh<D>& mesh, const Point<D>& x) {
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (!in_bounding_box<D>(mesh, mesh.elements[e], x)) continue;
    const auto lambda = barycentric<D>(mesh, mesh.elements[e], x);
    if (*std::min_element(lambda.begin(), lambda.end()) >= -rounding) return Place<D>{static_cast<Index>(e), lambda};
  }
  return std::nullopt;
}

template <int D>
double distance(const Point<D>& a, const Point<D>& b) {
  return length<D>(difference<D>(a, b));
}

template <int D>
Point<D> nearest_on_segment(const Point<D>& a, const Point<D>& b, const Point<D>& x) {
  const Point<D> ab = difference<D>(b, a);
  const double s = std::clamp(dot(difference<D>(x, a), ab) / dot(ab, ab), 0.0, 1.0);
  Point<D> out;
  for (int i = 0; i < D; ++i) out[i] = a[i] + s * ab[i];
  return out;
}

Point<2> nearest_on_face(const std::array<Point<2>, 2>& corner, const Point<2>& x) {
  return nearest_on_segment<2>(corner[0], corner[1], x);
}

// The foot of the perpendicular when it lies inside the triangle, otherwise the nearest point of its edges.
Point<3> nearest_on_face(const std::array<Point<3>, 3>& corner, const Point<3>& x) {
  Point<3> n = cross(difference<3>(corner[1], corner[0]), difference<3>(corner[2], corner[0]));
  normalise(n);
  const double height = dot(difference<3>(x, corner[0]), n);
  Point<3> foot;
  for (int i = 0; i < 3; ++i) foot[i] = x[i] - height * n[i];
  bool inside = true;
  Point<3> nearest{};
  double least = infinity;
  for (int a = 0; a < 3; ++a) {
    const Point<3>&p = corner[a], &q = corner[(a + 1) % 3];
    inside = inside && dot(cross(difference<3>(q, p), difference<3>(foot, p)), n) >= 0;
    const Point<3> candidate = nearest_on_segment<3>(p, q, x);
    if (const double d = distance<3>(candidate, x); d < least) {
      least = d;
      nearest = candidate;
    }
  }
  return inside ? foot : nearest;
}

}  // namespace

template <int D>
Place<D> locate(const Mesh<D>& mesh, const Point<D>& point, std::string_view origin) {
  if (const auto place = containing<D>(mesh, point)) return *place;
  Index element = -1;
  Point<D> nearest{};
  double least = infinity;
  for (const Face<D>& face : mesh.boundary) {
    std::array<Point<D>, D> corner;
    for (int a = 0; a < D; ++a) corner[a] = mesh.points[face.vertices[a]];
    const Point<D> candidate = nearest_on_face(corner, point);
    if (const double d = distance<D>(candidate, point); d < least) {
      least = d;
      nearest = candidate;
      element = face.element;
    }
  }
  if (element < 0 || least > longest_edge<D>(corners<D>(mesh.points, mesh.elements[element])))
    input_error(origin, fmt::format("point ({}) lies outside the body; the nearest point of the body is ({}), {} away",
                                    fmt::join(point, ", "), fmt::join(nearest, ", "), least));
  return {element, barycentric<D>(mesh, mesh.elements[element], nearest)};
}

template Place<2> locate<2>(const Mesh<2>&, const Point<2>&, std::string_view);
template Place<3> locate<3>(const Mesh<3>&, const Point<3>&, std::string_view);

}  // namespace signorini
