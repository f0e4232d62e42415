#pragma once
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// Where a mesh of a file hangs together by vertices or edges only, or has vertices inside faces of other elements: one
/// sentence each with the first such place, beginning with `place`.
template <int D>
std::vector<std::string> joint_warnings(const Mesh<D>& mesh, const std::string& place);

}  // namespace signorini
