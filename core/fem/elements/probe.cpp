#include "core/fem/elements/probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/nearest_on_face.hpp"
#include "core/mesh/curve.hpp"

namespace signorini {
namespace {

constexpr double boundary_rounding = 1e-6;  // of the vertices of mesh files in single precision
constexpr double beside_surface = 1e-3;     // of a face: a point written with few digits is on its curve

template <int D>
bool in_bounding_box(const Mesh<D>& mesh, const Simplex<D>& vertices, const Point<D>& x) {
  for (int i = 0; i < D; ++i) {
    double low = infinity, high = -infinity;
    for (const Index p : vertices) {
      low = std::min(low, mesh.points[p][i]);
      high = std::max(high, mesh.points[p][i]);
    }
    const double slack = rounding_of_differences * (high - low);
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
    if (*std::min_element(lambda.begin(), lambda.end()) >= -rounding_of_differences)
      return Place<D>{static_cast<Index>(e), lambda};
  }
  return std::nullopt;
}

template <int D>
double distance(const Point<D>& a, const Point<D>& b) {
  return length<D>(difference<D>(a, b));
}

template <int D>
std::array<Point<D>, D> corners_of(const Mesh<D>& mesh, const Face<D>& face) {
  std::array<Point<D>, D> corner;
  for (int a = 0; a < D; ++a) corner[a] = mesh.points[face.vertices[a]];
  return corner;
}

template <int D>
double longest_edge_of(const std::array<Point<D>, D>& corner) {
  double longest = 0;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < a; ++b) longest = std::max(longest, distance<D>(corner[a], corner[b]));
  return longest;
}

template <int D>
bool is_shape(const Mesh<D>& mesh, const Face<D>& face) {
  return face.curve >= 0 && mesh.curves[face.curve].is_shape();
}

// The largest angle at which a flat face and one beside it meet, as long as they meet smoothly.
template <int D>
double smooth_turn(const Mesh<D>& mesh, const Face<D>& face) {
  const auto unit_normal = [&](const Face<D>& f) {
    Point<D> n = area_normal(mesh, f);
    normalise(n);
    return n;
  };
  const Point<D> n = unit_normal(face);
  double cosine = 1;
  for (const Face<D>& other : mesh.boundary) {
    if (is_shape(mesh, other)) continue;
    if (std::ranges::find_first_of(face.vertices, other.vertices) == face.vertices.end()) continue;
    if (const double c = dot(n, unit_normal(other)); c > smooth_cosine) cosine = std::min(cosine, c);
  }
  return std::acos(cosine);
}

// How far outside a face the body may reach in truth where this point is. Of a shape no farther than that does.
template <int D>
double slack(const Mesh<D>& mesh, const Face<D>& face, const Point<D>& point) {
  const double h = longest_edge_of<D>(corners_of(mesh, face));
  if (!is_shape(mesh, face)) return h * (smooth_turn(mesh, face) / 2 + boundary_rounding);
  const Curve<D>& curve = mesh.curves[face.curve];
  Point<D> outwards = area_normal(mesh, face);
  normalise(outwards);
  if (dot(difference<D>(point, project<D>(curve, point)), outwards) > beside_surface * h) return h * boundary_rounding;
  return h * (h / least_radius<D>(curve, mesh.points[face.vertices[0]]) / 2 + boundary_rounding);
}

template <int D>
struct Outside {
  Point<D> nearest{};
  double distance = infinity;
  Index face = -1;
  double slack = 0;  // the largest of the faces that the nearest point lies on
};

template <int D>
Outside<D> outside(const Mesh<D>& mesh, const Point<D>& point) {
  std::vector<double> distances;
  Outside<D> out;
  for (const Face<D>& face : mesh.boundary) {
    const Point<D> candidate = nearest_on_face(corners_of(mesh, face), point);
    distances.push_back(distance<D>(candidate, point));
    if (distances.back() < out.distance)
      out = {candidate, distances.back(), static_cast<Index>(distances.size()) - 1, 0};
  }
  for (std::size_t f = 0; f < distances.size(); ++f)
    if (distances[f] <= out.distance * (1 + boundary_rounding))
      out.slack = std::max(out.slack, slack<D>(mesh, mesh.boundary[f], point));
  return out;
}

/// The family that a simplex belongs to, and which of its nodes the simplex has.
template <int D>
std::pair<Index, std::array<std::size_t, D + 1>> family_of(const Mesh<D>& mesh, const Simplex<D>& simplex) {
  std::array<std::size_t, D + 1> at{};
  const auto found = std::ranges::find_if(mesh.families, [&](const Family<D>& family) {
    for (std::size_t a = 0; a < simplex.size(); ++a)
      at[a] = static_cast<std::size_t>(std::ranges::find(family, simplex[a]) - family.begin());
    return std::ranges::max(at) < family.size();
  });
  assert(found != mesh.families.end());
  return {static_cast<Index>(found - mesh.families.begin()), at};
}

/// Newton's method for the point of a curved element: the start is that of the straight one, and stays where there is
/// none.
template <int D>
void move_to(const Point<D>& x, const ElementMap<D, D, 2>& map, std::array<double, D + 1>& barycentric) {
  constexpr int enough = 20;
  const std::array<double, D + 1> start = barycentric;
  for (int k = 0; k < enough && map.curved(); ++k) {
    const LinearElement<D> flat = linear_element(map.flat(barycentric));
    const Point<D> left = difference<D>(x, map(barycentric));
    double moved = 0;
    for (int a = 0; a <= D; ++a) {
      const double by = dot(flat.gradient[a], left);
      barycentric[a] += by;
      moved = std::max(moved, std::abs(by));
    }
    if (moved <= rounding_of_differences) return;
  }
  barycentric = start;
}

}  // namespace

template <int D>
Place<D> in_element(const Nodes<D>& nodes, const Place<D>& in_simplex) {
  if (nodes.order() == 1) return in_simplex;
  const Mesh<D>& mesh = nodes.mesh();
  const Simplex<D>& simplex = mesh.elements[in_simplex.element];
  const auto [element, at] = family_of(mesh, simplex);
  Place<D> out{element, {}};
  for (std::size_t a = 0; a < at.size(); ++a) {
    const auto of_node = node_place<D>(at[a]);
    for (int k = 0; k <= D; ++k) out.barycentric[k] += in_simplex.barycentric[a] * of_node[k];
  }
  move_to<D>(combine<D>(mesh, simplex, in_simplex.barycentric), ElementMap<D, D, 2>(mesh, mesh.families[element]),
             out.barycentric);
  return out;
}

template Place<2> in_element(const Nodes<2>&, const Place<2>&);
template Place<3> in_element(const Nodes<3>&, const Place<3>&);

template <int D>
Place<D> locate(const Mesh<D>& mesh, const Point<D>& point, std::string_view origin) {
  if (const auto place = containing<D>(mesh, point)) return *place;
  const Outside<D> found = outside<D>(mesh, point);
  const Face<D>& face = mesh.boundary[found.face];
  if (!(found.distance <= found.slack)) {
    const Point<D> nearest = is_shape(mesh, face) ? project<D>(mesh.curves[face.curve], point) : found.nearest;
    input_error(origin,
                fmt::format("point ({}) lies outside the body; the nearest point of the body is ({}), {:.6g} away",
                            fmt::join(point, ", "), fmt::join(nearest, ", "), distance<D>(nearest, point)));
  }
  const bool on_face = found.distance <= boundary_rounding * longest_edge_of<D>(corners_of(mesh, face));
  return {face.element, barycentric<D>(mesh, mesh.elements[face.element], on_face ? found.nearest : point)};
}

template Place<2> locate<2>(const Mesh<2>&, const Point<2>&, std::string_view);
template Place<3> locate<3>(const Mesh<3>&, const Point<3>&, std::string_view);

}  // namespace signorini
