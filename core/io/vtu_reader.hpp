#pragma once
#include <string_view>

#include "core/io/mesh_file.hpp"

namespace signorini {

/// Reads a VTK unstructured grid in XML from memory: ascii, inline binary, appended raw and base64 data, with or
/// without zlib, both byte orders, 32 and 64 bit headers ("VTK file formats", VTK user's guide). See read_any_mesh.
AnyMesh read_vtu(std::string_view content, std::string_view place, FileGroups* groups = nullptr);

}  // namespace signorini
