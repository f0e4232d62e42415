#include "core/io/surface_reader.hpp"

#include <fmt/format.h>

#include <cctype>
#include <string>

#include "core/base/error.hpp"
#include "core/io/read_file.hpp"
#include "core/io/surface_formats.hpp"

namespace signorini {
namespace {

struct SurfaceFormat {
  std::string_view name;
  PolygonSoup (*read)(std::string_view content, std::string_view place);
};
constexpr SurfaceFormat surface_formats[] = {
    {"off", read_off}, {"obj", read_obj}, {"stl", read_stl}, {"ply", read_ply}};

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string().substr(file.has_extension() ? 1 : 0);
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace

PolygonSoup parse_surface(std::string_view content, std::string_view format, std::string_view place) {
  for (const SurfaceFormat& known : surface_formats) {
    if (known.name != format) continue;
    PolygonSoup soup = known.read(content, place);
    if (soup.faces.empty()) input_error(place, "no faces; expected a surface of triangles or polygons");
    return soup;
  }
  input_error(place,
              "the name does not tell the format of a surface; expected OFF, OBJ, STL or PLY, in a file that ends "
              "in .off, .obj, .stl or .ply");
}

PolygonSoup read_surface(const std::filesystem::path& file) {
  return parse_surface(read_file(file, "surface file"), lower_extension(file), file.string());
}

}  // namespace signorini
