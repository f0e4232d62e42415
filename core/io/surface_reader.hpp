#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// Polygons in space, as a surface file lists them: neither merged nor oriented. Their vertices are among the points,
/// which are finite.
struct PolygonSoup {
  std::vector<Point<3>> points;
  std::vector<std::vector<std::size_t>> faces;  ///< by three points at least
};

/// Reads OFF, OBJ, STL or PLY, which the end of the name tells. What a format holds beside points and faces is left
/// out: colours, normals, textures, lines, groups. Anything wrong is an Error(Exit::input) that names the file and the
/// line or byte.
PolygonSoup read_surface(const std::filesystem::path& file);

/// The same from memory.
/// @param format "off", "obj", "stl" or "ply"
/// @param place the name in messages
PolygonSoup parse_surface(std::string_view content, std::string_view format, std::string_view place);

}  // namespace signorini
