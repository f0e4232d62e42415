#include "core/io/foreign_formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <vector>

namespace signorini {
namespace {

constexpr std::string_view to_be_converted =
    "which is not read; expected a file that Gmsh or meshio has converted: `gmsh OLD -save -o NEW.msh`, `meshio "
    "convert OLD NEW.vtu`";
// Gmsh cannot read these, and meshio's first format for names in .msh is that of another program.
constexpr std::string_view for_meshio =
    "which is not read; expected a file that meshio has converted: `meshio convert OLD NEW.vtu`, one for each part";
constexpr std::string_view surface =
    "a surface without elements inside; expected a mesh, or shape = \"solid\" and file = this one in place of 'mesh'";

struct Format {
  std::string_view name;
  std::vector<std::string_view> extensions;  ///< of names, in lower case
  std::vector<std::string_view> beginnings;  ///< of some line, the first one where the format has a fixed beginning
  bool at_first = true;
  std::string_view advice = to_be_converted;
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {
      {"a Nastran file", {"nas", "bdf", "nastran", "fem"}, {"BEGIN BULK", "GRID ", "GRID,", "GRID*"}, false},
      {"an Abaqus or CalculiX file", {"inp"}, {"*HEADING", "*NODE", "*PART"}, false, for_meshio},
      {"a Universal (I-DEAS) file", {"unv", "uff"}, {}},
      {"a legacy VTK file", {"vtk"}, {"# vtk DataFile"}},
      {"a MEDIT file", {"mesh", "meshb"}, {"MeshVersionFormatted"}},
      {"a Netgen file", {"vol"}, {"mesh3d"}},
      {"an HDF5 file such as MED, CGNS or XDMF", {"med", "cgns", "h5", "xdmf"}, {"\x89HDF"}},
      {"a NetCDF file such as Exodus", {"exo", "ex2", "nc"}, {"CDF\x01", "CDF\x02"}},
      {"a file packed by gzip", {"gz"}, {"\x1f\x8b"}, true, "which is not read; expected an unpacked one"},
      {"a geometry without a mesh",
       {"geo", "step", "stp", "iges", "igs", "brep"},
       {"ISO-10303-21", "DBRep_DrawableShape"},
       true,
       "which is not read; expected what Gmsh makes of it: `gmsh OLD -3 -o NEW.msh`"},
      {"an STL file", {"stl"}, {"solid "}, true, surface},
      {"an OFF file", {"off"}, {"OFF"}, true, surface},
      {"a PLY file", {"ply"}, {"ply\n", "ply\r"}, true, surface},
      {"an OBJ file", {"obj"}, {}, true, surface}};
  return all;
}

std::string lower_extension(std::string_view place) {
  std::string extension = std::filesystem::path(place).extension().string();
  extension.erase(0, 1);
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

bool begins_with(std::string_view text, std::string_view beginning) {
  const auto upper = [](unsigned char c) { return std::toupper(c); };
  return std::ranges::equal(text.substr(0, beginning.size()), beginning, {}, upper, upper);
}

bool recognised(std::string_view content, const Format& format) {
  for (std::size_t line = 0; line < content.size();) {
    const std::size_t start = std::min(content.find_first_not_of(" \t", line), content.size());
    for (const std::string_view beginning : format.beginnings)
      if (begins_with(content.substr(start), beginning)) return true;
    if (format.at_first) return false;
    line = std::min(content.find('\n', start), content.size() - 1) + 1;
  }
  return false;
}

}  // namespace

std::string foreign_format(std::string_view content, std::string_view place) {
  const auto complaint = [](const Format& format) {
    return std::string(format.name) + ", " + std::string(format.advice);
  };
  for (const Format& format : formats())
    if (recognised(content, format)) return complaint(format);
  const std::string extension = lower_extension(place);
  for (const Format& format : formats())
    if (std::ranges::find(format.extensions, extension) != format.extensions.end()) return complaint(format);
  return {};
}

}  // namespace signorini
