#include "core/io/mesh_file.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/io/foreign_formats.hpp"
#include "core/io/msh_reader.hpp"
#include "core/io/read_file.hpp"
#include "core/io/vtu_reader.hpp"

namespace signorini {
namespace {

/// What programs leave behind the end: blanks, and ends of strings and of files.
constexpr std::string_view trailing("\0\x1a \t\r\n", 6);

}  // namespace

AnyMesh parse_mesh(std::string_view content, std::string_view place, FileGroups* groups) {
  content.remove_prefix(content.starts_with("\xEF\xBB\xBF") ? 3 : 0);   // byte order mark
  content = content.substr(0, content.find_last_not_of(trailing) + 1);  // all formats end with a word
  const std::size_t first = content.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) input_error(place, "the mesh file is empty");
  const auto holds = [&](std::string_view section) { return content.find(section, first) != std::string_view::npos; };
  // Comments of other formats begin likewise.
  if (content[first] == '$' && (holds("$MeshFormat") || holds("$NOD"))) return read_msh(content, place, groups);
  if (content[first] == '<') return read_vtu(content.substr(first), place, groups);
  if (const std::string foreign = foreign_format(content, place); !foreign.empty()) input_error(place, foreign);
  input_error(place, fmt::format("neither a Gmsh MSH file, which has a section $MeshFormat, nor a VTU file, which is "
                                 "XML; found byte 0x{:02x} first",
                                 static_cast<unsigned char>(content[first])));
}

AnyMesh read_any_mesh(const std::filesystem::path& path, FileGroups* groups) {
  return parse_mesh(read_file(path, "mesh file"), path.string(), groups);
}

template <int D>
Mesh<D> read_mesh(const std::filesystem::path& path, FileGroups* groups) {
  AnyMesh mesh = read_any_mesh(path, groups);
  if (auto* found = std::get_if<Mesh<D>>(&mesh)) return std::move(*found);
  input_error(path.string(), fmt::format("found a mesh of dimension {}, expected {}", 5 - D, D));
}

int mesh_dimension(const std::filesystem::path& path) {
  return std::holds_alternative<Mesh<2>>(read_any_mesh(path)) ? 2 : 3;
}

template Mesh<2> read_mesh<2>(const std::filesystem::path&, FileGroups*);
template Mesh<3> read_mesh<3>(const std::filesystem::path&, FileGroups*);

}  // namespace signorini
