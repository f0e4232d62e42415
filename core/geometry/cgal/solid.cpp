#include "core/geometry/cgal/solid.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/geometry/cgal/nearest.hpp"
#include "core/geometry/smooth_boundary.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

SolidDomain::SolidDomain(const std::string& file) : surface_(file, TriangleSurface::Coordinates::own) {
  if (!surface_.closed())
    input_error(file, fmt::format("the surface is not closed, it has {} border edges; expected a closed surface",
                                  surface_.border_edges()));
  for (const auto& [a, b, c] : surface_.triangles()) {
    const auto& p = surface_.points();
    if (length<3>(cross(difference<3>(p[b], p[a]), difference<3>(p[c], p[a]))) > 0) continue;
    const auto at = surface_.given_points()[a];
    input_error(file, fmt::format("a face has no area, near [{:g}, {:g}, {:g}]; expected triangles that are no lines",
                                  at[0], at[1], at[2]));
  }
  if (const auto pair = surface_.self_intersection()) {
    const auto at = surface_.given_points()[surface_.triangles()[pair->first][0]];
    input_error(file, fmt::format("the surface intersects itself, near [{:g}, {:g}, {:g}]", at[0], at[1], at[2]));
  }
  const auto nesting = surface_.nesting();
  const auto outer = std::count(nesting.begin(), nesting.end(), 0u);
  if (outer > 1 || std::any_of(nesting.begin(), nesting.end(), [](std::size_t level) { return level > 1; }))
    input_error(file,
                fmt::format("the surface has {} components that bound more than one piece; expected one connected "
                            "solid",
                            nesting.size()));
  creases_ = find_creases(surface_, default_crease);
  flat_ = std::ranges::all_of(creases_.curved_piece, [](Index piece) { return piece < 0; });
}

double SolidDomain::volume() const {
  double sum = 0;
  const Point<3> origin = surface_.box().low;
  for (const auto& [a, b, c] : surface_.triangles()) {
    const auto& p = surface_.points();
    sum += signed_volume<3>({origin, p[a], p[b], p[c]});
  }
  return std::abs(sum);
}

std::optional<Point<3>> SolidDomain::crossing(const Point<3>& a, const Point<3>& b) const {
  const auto p = surface_.crossing(a, b);
  // Points on the surface count as outside, for crossings as for inside(): what touches it from outside does not cross.
  if ((p == a && !inside(b)) || (p == b && !inside(a))) return {};
  return p;
}

std::vector<Point<3>> SolidDomain::surface_points() const {
  constexpr std::size_t count = 20;
  const auto& triangles = surface_.triangles();
  std::vector<Point<3>> points;
  for (std::size_t i = 0; i < std::min(count, triangles.size()); ++i) {
    Point<3>& centroid = points.emplace_back(Point<3>{});
    for (const Index v : triangles[i * triangles.size() / std::min(count, triangles.size())])
      for (std::size_t k = 0; k < 3; ++k) centroid[k] += surface_.points()[v][k] / 3;
  }
  return points;
}

double SolidDomain::off_surface(const Point<3>& p) const {
  const auto& [a, b, c] = surface_.triangles()[surface_.nearest_triangle(p)];
  const std::array corners{surface_.points()[a], surface_.points()[b], surface_.points()[c]};
  const auto weights = nearest_weights(p, corners);
  Point<3> at{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) at[k] += weights[i] * corners[i][k];
  return length<3>(difference<3>(p, at));
}

double SolidDomain::coarsest_size() const {
  const auto [low, high] = box();
  return std::min({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

// What is at a vertex, or on a flat face along the axes, is exactly so in the user's coordinates too.
Point<3> SolidDomain::given_on_surface(const Point<3>& p) const {
  const auto &own = surface_.points(), &points = surface_.given_points();
  const auto& triangle = surface_.triangles()[surface_.nearest_triangle(p)];
  const auto weights = nearest_weights(p, std::array{own[triangle[0]], own[triangle[1]], own[triangle[2]]});
  const auto base = static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  Point<3> q = points[triangle[base]];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) q[k] += weights[i] * (points[triangle[i]][k] - points[triangle[base]][k]);
  return q;
}

// How far flat faces are off the triangles, where these are round.
SurfacePiece SolidDomain::piece_of(const Mesh<3>& mesh) const {
  double most = 0;
  for (const Face<3>& face : mesh.boundary) {
    Point<3> center{};
    for (const Index v : face.vertices)
      for (std::size_t k = 0; k < 3; ++k) center[k] += mesh.points[v][k] / 3;
    most = std::max(most, off_surface(center));
  }
  const auto [low, high] = box();
  return {.kind = "triangles",
          .faces = static_cast<Index>(mesh.boundary.size()),
          .deviation = most * units().unit,
          .size = length<3>(difference<3>(high, low)) * units().unit};
}

void SolidDomain::finish(Mesh<3>& mesh, const std::vector<bool>&) const {
  if (!flat_) mesh.pieces.push_back(piece_of(mesh));
  std::vector<bool> on_surface(mesh.points.size(), false);
  for (const Face<3>& face : mesh.boundary)
    for (const Index v : face.vertices) on_surface[v] = true;
  for (std::size_t v = 0; v < on_surface.size(); ++v)
    mesh.points[v] = on_surface[v] ? given_on_surface(mesh.points[v]) : units().given(mesh.points[v]);
}

}  // namespace signorini::geometry
