#pragma once
#include "core/geometry/cgal/domain.hpp"
#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// Fills a domain with tetrahedra by Delaunay refinement, mean edge about `size`. The mesh, the points that the size is
/// asked for and its values are in the user's coordinates.
Mesh<3> tetrahedralize(const Domain& domain, const Size<3>& size);

}  // namespace signorini::geometry
