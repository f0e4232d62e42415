#include "core/geometry/cgal/shape_foot.hpp"

#include <optional>

#include "core/base/dot.hpp"
#include "core/geometry/cgal/nearest.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

/// Whether several points of the shape are as near, as to a point of its axis.
bool is_undecided(const Curve<3>& shape, const Point<3>& p, const Point<3>& on_shape) {
  if (on_shape != p) return false;
  const auto off = height<3>(shape, p);
  return !off || (off->normal == Point<3>{} && off->distance != 0);
}

/// Whether a point of the shape with this foot on the patch is on the patch's part of it.
bool covers(const ShapePatch& part, const Point<3>& on_shape, const PatchFoot& below) {
  if (below.inside) return true;
  for (int k = 0; k < 3; ++k)
    if (below.weights[k] == 0 && !part.goes_on[k]) return false;
  return length<3>(difference<3>(on_shape, below.at)) <= part.off;
}

/// Of the shape, to the patch's side; that of the patch at a tip.
Point<3> normal_at(const ShapePatch& part, const PatchFoot& foot) {
  const auto off = height<3>(part.shape, foot.at);
  if (!off || off->normal == Point<3>{}) return foot.normal;
  Point<3> n = off->normal;
  for (double& x : n) x *= part.side;
  return n;
}

PatchFoot put_on(const ShapePatch& part, PatchFoot foot) {
  foot.at = project<3>(part.shape, foot.at);
  foot.normal = normal_at(part, foot);
  return foot;
}

/// The foot of a point of the shape on the patch, if the patch's part of the shape has that point.
std::optional<PatchFoot> below(const ShapePatch& part, const Point<3>& on_shape) {
  const auto& control = part.patch.control;
  const std::array<Point<3>, 3> corner{control[0], control[1], control[2]};
  const auto start = nearest_weights(on_shape, corner);
  Point<3> aside = on_shape;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) aside[i] -= start[k] * corner[k][i];
  if (!(length<3>(aside) <= 2 * part.off)) return {};
  const PatchFoot foot = nearest_on_patch(part.patch, on_shape, start);
  return covers(part, on_shape, foot) ? std::optional(foot) : std::nullopt;
}

}  // namespace

PatchFoot nearest_on_shape(const ShapePatch& part, const Point<3>& p, const std::array<double, 3>& start) {
  const Point<3> on_shape = project<3>(part.shape, p);
  auto foot = is_undecided(part.shape, p, on_shape) ? std::nullopt : below(part, on_shape);
  if (!foot) return put_on(part, nearest_on_patch(part.patch, p, start));
  foot->at = on_shape;
  foot->normal = normal_at(part, *foot);
  return *foot;
}

}  // namespace signorini::geometry
