#pragma once
#include <string_view>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// Prepares a coarsest mesh that is read as (r, z), the half plane that turns around the axis r = 0. The axis is no
/// boundary: faces on it leave the boundary and its parts. Vertices within 1e-9 of the largest radius are moved onto
/// it. A vertex beyond the axis is an Error(Exit::input) at `place` that says where it is.
void read_as_meridian(Mesh<2>& mesh, std::string_view place);

}  // namespace signorini
