#pragma once
#include <string_view>

#include "core/io/mesh_file.hpp"

namespace signorini {

/// Reads a Gmsh MSH file from memory: versions 2.2 and 4.1, ASCII and binary of either byte order (Gmsh reference
/// manual, "MSH file format"). See read_any_mesh.
AnyMesh read_msh(std::string_view content, std::string_view place, FileGroups* groups = nullptr);

}  // namespace signorini
