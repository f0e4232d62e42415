#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/joints.hpp"

namespace signorini::geometry {

/// Vertices that a surface is pointed at, as at the apex of a cone: no edge there is sharp, but the faces around take
/// more away from the full angle than those of a cone whose opposite sides meet at the crease's angle, and the surface
/// around is far less curved, per area.
/// @param sharp per joint, of find_edges(); borders count as such
/// @return per vertex
std::vector<std::uint8_t> find_tips(std::span<const Point<3>> points, const std::vector<std::array<Index, 3>>& faces,
                                    const Joints<3>& joints, const std::vector<std::uint8_t>& sharp, double crease);

}  // namespace signorini::geometry
