#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

using AnyMesh = std::variant<Mesh<2>, Mesh<3>>;

/// What a file groups beside the faces of the boundary.
struct FileGroups {
  struct OffBoundary {
    std::string name;
    std::size_t faces;      ///< in the group
    std::size_t elsewhere;  ///< of these, inside the mesh or of no element
  };
  std::map<std::string, std::vector<Index>> of_elements;  ///< elements of the mesh by the name of their group
  std::vector<OffBoundary> off_boundary;
};

/// Reads a Gmsh MSH file (1, 2.0 to 2.2, 4.0 or 4.1, ASCII or binary) or a VTU file, told apart by their content.
/// Tetrahedra make a Mesh<3>; triangles without tetrahedra, all in one plane z = const, a Mesh<2>. Physical groups of
/// faces become parts by their name, or by their number where they have none; in VTU files the groups are the values of
/// an integer cell array ("gmsh:physical", "CellEntityIds", "physical", "medit:ref" or "PhysicalIds").
///
/// Anything wrong is an Error(Exit::input) naming the file and the line or byte.
/// @param groups is told the groups that are no parts, or not as a whole
AnyMesh read_any_mesh(const std::filesystem::path& path, FileGroups* groups = nullptr);

/// The same where the dimension is known; a mesh of the other one is an error.
template <int D>
Mesh<D> read_mesh(const std::filesystem::path& path, FileGroups* groups = nullptr);

/// 2 or 3. Reads the whole file.
int mesh_dimension(const std::filesystem::path& path);

/// The same from memory; `place` is the name used in messages.
AnyMesh parse_mesh(std::string_view content, std::string_view place, FileGroups* groups = nullptr);

}  // namespace signorini
