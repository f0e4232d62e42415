#include "core/mortar/side.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/mesh/element_map.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::mortar {
namespace {

// A face whose area is less than this part of that of the square over its longest edge has no normal to speak of.
constexpr double flat = 1e-12;

template <int D>
[[noreturn]] void refuse(const SurfaceFaces<D>& surface, std::size_t face, const std::string& what) {
  input_error(surface.place,
              fmt::format("face {} with the nodes {} {}", face, fmt::join(surface.faces[face], " "), what));
}

template <int D>
std::array<Point<D>, D> checked_corners(const SurfaceFaces<D>& surface, std::size_t face) {
  std::array<Point<D>, D> out;
  for (int i = 0; i < D; ++i) {
    const Index v = surface.faces[face][i];
    if (v < 0 || static_cast<std::size_t>(v) >= surface.points.size())
      refuse(surface, face, fmt::format("names node {}, expected 0 to {}", v, Offset(surface.points.size()) - 1));
    out[i] = surface.points[v];
    for (const double x : out[i])
      if (!std::isfinite(x))
        refuse(surface, face, fmt::format("has node {} at a coordinate {}, expected a finite one", v, x));
  }
  return out;
}

template <int D>
double longest_side(const std::array<Point<D>, D>& corner) {
  double longest = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < i; ++j) longest = std::max(longest, length<D>(difference<D>(corner[i], corner[j])));
  return longest;
}

/// The area over that of the square with the longest edge; the normal of length 1 where that is not zero. Scaled first,
/// so that nothing underflows.
template <int D>
double relative_area(std::array<Point<D>, D> corner, double longest, Point<D>& normal) {
  std::array<Point<D>, D - 1> edge;
  for (int i = 0; i < D - 1; ++i) {
    edge[i] = difference<D>(corner[i + 1], corner[0]);
    for (double& x : edge[i]) x /= longest;
  }
  if constexpr (D == 2)
    normal = {edge[0][1], -edge[0][0]};
  else
    normal = cross(edge[0], edge[1]);
  const double size = length<D>(normal);
  for (double& x : normal) x /= size;
  return size / (D - 1);
}

}  // namespace

template <int D>
Side<D>::Side(const SurfaceFaces<D>& surface)
    : faces(surface.faces),
      number(surface.points.size(), -1),
      undeformed_(surface.undeformed),
      in_mesh_(surface.number) {
  corner.reserve(faces.size());
  normal.resize(faces.size());
  area.resize(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    corner.push_back(checked_corners(surface, f));
    const double longest = longest_side<D>(corner[f]);
    const double relative = longest > 0 ? relative_area<D>(corner[f], longest, normal[f]) : 0;
    if (!(relative > flat)) refuse(surface, f, "has no area, expected a face that is not degenerate");
    area[f] = D == 2 ? longest : relative * longest * longest;
    if (!std::isfinite(area[f]) || !(area[f] > 0))
      refuse(surface, f, "is too large or too small for its area to be a number");
    for (const Index v : faces[f]) number[v] = 0;
  }
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] == 0) {
      number[v] = static_cast<Index>(node.size());
      node.push_back(static_cast<Index>(v));
    }
  if (!undeformed_ || undeformed_->curves.empty()) return;
  for (const Index f : in_mesh_) {
    bent_.push_back(signorini::stands_for_surface(*undeformed_, f));
    flat_normal_.push_back(area_normal(points_of(undeformed_->points, undeformed_->boundary[f].vertices)));
    const double size = length<D>(flat_normal_.back());
    for (double& c : flat_normal_.back()) c /= size;
  }
}

template <int D>
SurfacePoint<D> Side<D>::surface(Index face, const std::array<double, D>& barycentric,
                                 const Point<D>& direction) const {
  SurfacePoint<D> out = surface_at<D>(*undeformed_, in_mesh_[face], barycentric, direction);
  for (int k = 0; k < D; ++k) out.normal[k] += normal[face][k] - flat_normal_[face][k];
  const double size = length<D>(out.normal);
  for (double& c : out.normal) c /= size;
  return out;
}

template struct Side<2>;
template struct Side<3>;

}  // namespace signorini::mortar
