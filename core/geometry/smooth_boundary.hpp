#pragma once
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "core/geometry/known.hpp"
#include "core/mesh/cubic_patch.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// Faces that meet at a larger angle meet at an edge of the body (2D: a corner) in any case: 35 degrees.
inline constexpr double default_crease = 35 * std::numbers::pi / 180;

/// A smooth surface (2D: a curve) through the vertices of flat faces that keeps creases, see find_edges(): cubic
/// patches, one per face, that have edges in common where faces have, and vertex normals in common but across creases.
///
/// What is on a cylinder, cone, sphere or torus, see find_shape_parts(), has the shape's normals; where shapes and
/// planes meet at an angle there is an edge. Rows of faces from edge to edge are straight across.
///
/// Elsewhere normals are those of local polynomials through the vertex (jets: Cazals and Pouget, Estimating
/// differential quantities using polynomial fitting of osculating jets, 2005), fitted to the vertices around it on its
/// side of creases; flat parts of more than a row of faces stay flat. An edge is the cubic curve that leaves its ends
/// in the tangent planes, on a sphere with exact normals up to the sixth power of its length. Between patches normals
/// differ by the third power.
template <int D>
struct SmoothBoundary {
  std::vector<CubicPatch<D>> patches;  ///< per face
  std::vector<Index> piece;            ///< per face the smooth piece it belongs to, from 0
  Index pieces = 0;
  std::vector<Index> flat;                       ///< per face the number of its flat part, or -1
  std::vector<double> turn;                      ///< per face the largest angle to a neighbour on its side of creases
  std::vector<std::array<Point<D>, D>> normals;  ///< per face, at its corners, of unit length
  std::vector<Index> shape;                      ///< per face the number of the shape that it is on, or -1
  std::vector<Curve<D>> shapes;                  ///< see find_shape_parts()
};

/// @param faces oriented alike: normals to the left hand (D = 2: to the right) of the order of the corners
/// @param crease angle between normals in radians, from 0 to pi, from which on there is a crease in any case
/// @param known of curved faces there are only pieces, flat parts and shapes, no patches
template <int D>
SmoothBoundary<D> smooth_boundary(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces,
                                  double crease, const Known<D>& known = {});

/// The largest distance between a patch and its flat face, from above.
template <int D>
double bulge(const CubicPatch<D>& patch);

}  // namespace signorini::geometry
