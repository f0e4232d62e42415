#pragma once
#include "core/geometry/cgal/triangle_surface.hpp"

namespace signorini::geometry {

/// Where a triangle surface is not smooth, as find_edges() tells it.
struct Creases {
  std::vector<Polyline> lines;      ///< sharp edges; they end where not two of them meet, or meet at an angle
  std::vector<Point<3>> tips;       ///< vertices off these that the surface is pointed at, as at the apex of a cone
  std::vector<Index> curved_piece;  ///< per triangle the piece of the surface that it is of; -1 where that is flat,
                                    ///< up to what files round away
};

/// @param crease angle in radians from which on faces, and edges that follow each other, meet at an angle in any case
Creases find_creases(const TriangleSurface& surface, double crease);

}  // namespace signorini::geometry
