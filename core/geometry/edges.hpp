#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/joints.hpp"

namespace signorini::geometry {

struct Edges {
  std::vector<std::uint8_t> sharp;  ///< per joint: faces that have it in common meet at an edge of the body
  std::vector<double> angle;        ///< per face and tip, between normals, in radians; 0 where no face is beyond
};

/// Tells edges of a body (2D: corners) from joints between flat faces that stand for a round surface: by what each side
/// shows when it is seen for itself.
///
/// Faces in one plane are one plate. A plate of several faces across a joint is flat: nobody divides the chord of an
/// arc. Beside other plates, the surface goes on with the curvature that its faces there have: the quadratic surface
/// through the vertices on one side of the joint, tangent to flat plates, has a normal at the joint. Where the normals
/// of both sides are nearer to each other than half the angle between the faces, the joint is one of a round surface.
/// Around a tip, with plates that get wider away from it, the angle at the next joint counts by the widths of the
/// plates. Four points on an arc may be a chamfered block as well: so there have to be joints on both sides that turn
/// on, or on one side one that has been found to be round before; or two joints between three faces of one height that
/// meet at one angle, as no chamfers do but by chance. What nothing tells to be round is an edge, whatever its angle.
///
/// Of curved faces the angle between their normals is taken as it is, beside that by which they turn themselves.
/// @param crease angle in radians from which on there is an edge in any case
/// @param normal of curved faces, see Known
template <int D>
Edges find_edges(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces,
                 const Joints<D>& joints, double crease, const std::vector<std::array<Point<D>, D>>& normal = {});

}  // namespace signorini::geometry
