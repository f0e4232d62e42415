#pragma once
#include <array>

#include "core/geometry/cgal/patch_foot.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// A patch that stands for its part of a shape with a closed form.
struct ShapePatch {
  const CubicPatch<3>& patch;
  const Curve<3>& shape;
  double side = 1;                   ///< -1 where the patch looks into the shape
  double off = 0;                    ///< from above, how far the patch and its flat face are off the shape
  std::array<bool, 3> goes_on = {};  ///< whether the shape goes on beyond the edge opposite to each corner
};

/// The point of the shape nearest to another point, where it is on the part that the patch stands for, or else that
/// part's nearest border. Exact on the shape, while the patch has but one tangent plane at the tip of a cone.
/// @param start barycentric, near it
PatchFoot nearest_on_shape(const ShapePatch& part, const Point<3>& p, const std::array<double, 3>& start);

}  // namespace signorini::geometry
