#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/io/picture.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// A plane through a point, spanned by two orthogonal unit vectors that point to the right and upwards in the picture.
struct Section {
  Point<3> through, right, up;
};

/// The section of tetrahedra with a plane.
/// @param points, value one per vertex
std::vector<Patch> slice(std::span<const std::array<Index, 4>> elements, std::span<const Point<3>> points,
                         std::span<const double> value, const Section& section);

}  // namespace signorini
