#pragma once
#include <span>
#include <string_view>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// Throws Error(Exit::input) at `place` unless the mesh is one on which a problem can be posed: not empty, points
/// finite, vertices in range, elements positively oriented and not degenerate (volume at least 1e-14 of h^D, h the
/// longest edge), faces shared by at most two elements that lie on different sides of it, every vertex used, connected.
/// Messages name an element by its entry in `label`, its number in the file, or else by its position, from 0.
template <int D>
void validate(const Mesh<D>& mesh, std::string_view place, std::span<const Offset> label = {});

}  // namespace signorini
