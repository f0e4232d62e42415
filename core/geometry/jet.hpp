#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/base/types.hpp"

namespace signorini::geometry {

/// The highest degree of a jet, see below.
template <int D>
inline constexpr int highest_jet = D == 2 ? 4 : 3;

/// How many points a jet takes at least: on surfaces some more than it has terms, or the fit would follow its noise.
template <int D>
constexpr std::size_t points_for_jet(int degree) {
  if (D == 2) return static_cast<std::size_t>(degree);
  return static_cast<std::size_t>((degree + 1) * (degree + 2) / 2 - 1 + 2 * degree - 2);
}

/// The unit normal, at the origin, of a polynomial height over the plane across `up` that vanishes there and is nearest
/// to some points in the sense of least squares, weighted by the inverse of their distance. (Cazals and Pouget,
/// Estimating differential quantities using polynomial fitting of osculating jets, 2005.)
/// @param digits length by which points may be off, see rounded_away(): what it alone tells is not determined
/// @return nothing where the points do not determine it
template <int D>
std::optional<Point<D>> jet_normal(std::span<const Point<D>> points, const Point<D>& up, int degree, double digits);

/// The unit tangent at point `at`, 0 or 1, of a curve through three or more points that follow each other. The
/// curvature is taken to change linearly, as the circles through three points each say: on a circle the tangent is
/// exact. The angle between tangent and chord is half the length times the curvature a third of the way along.
/// @return nothing where the curve turns by more than 60 degrees there
std::optional<Point<2>> end_tangent(const std::vector<Point<2>>& points, std::size_t at);

}  // namespace signorini::geometry
