#pragma once
#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// Triangulates the inside of a disk, half disk or polygon by Delaunay refinement, mean edge about `size`, no angle
/// below 20 degrees unless the outline has one.
Mesh<2> triangulate(const Shape2& shape, const Size<2>& size);

}  // namespace signorini::geometry
