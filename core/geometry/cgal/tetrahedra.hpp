#pragma once
#include "core/geometry/cgal/domain.hpp"
#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// Fills a domain with tetrahedra by Delaunay refinement, mean edge about `size`. The domain and the mesh are in units
/// of `unit`, the points that the size is asked for and its values are in the user's.
Mesh<3> tetrahedralize(const Domain& domain, const Size<3>& size, double unit);

}  // namespace signorini::geometry
