#pragma once
#include "core/mesh/cubic_patch.hpp"

namespace signorini::geometry {

/// The point of a patch nearest to another point.
struct PatchFoot {
  Point<3> at{};
  Point<3> normal{};                ///< of the patch there, of any length
  std::array<double, 3> weights{};  ///< barycentric; exactly zero on the patch's edges
  bool inside = false;              ///< not on an edge
};

/// By Newton's method, on the patch and, where that leaves it, on its edges.
/// @param start barycentric, near it
PatchFoot nearest_on_patch(const CubicPatch<3>& patch, const Point<3>& p, const std::array<double, 3>& start);

}  // namespace signorini::geometry
