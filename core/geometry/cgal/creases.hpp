#pragma once
#include "core/geometry/cgal/triangle_surface.hpp"

namespace signorini::geometry {

/// The edges across which the normal of a closed surface turns by more than `angle` (radians), joined to polylines that
/// end where not exactly two of them meet, or where they turn by more than `angle` themselves.
std::vector<Polyline> find_creases(const TriangleSurface& surface, double angle);

}  // namespace signorini::geometry
