#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/mesh_file.hpp"

namespace signorini {

/// The nodes in the middle of the edges of a cell, in the order of simplex_edges; -1 where it has none.
template <int Corners>
using MiddleNodes = std::array<Index, Corners*(Corners - 1) / 2>;

template <int Corners>
constexpr MiddleNodes<Corners> no_middle_nodes() {
  MiddleNodes<Corners> out;
  out.fill(-1);
  return out;
}

/// Cells of one shape as a file gives them, by vertices counted from 0.
template <int Corners>
struct FileCells {
  std::vector<std::array<Index, Corners>> vertices;
  std::vector<MiddleNodes<Corners>> middle;  ///< empty where all cells are of first order
  std::vector<Offset> label;                 ///< number in the file
  std::vector<Index> group;                  ///< geometric entity or group it belongs to, counted from 0

  void add(const std::array<Index, Corners>& v, Offset number, Index where,
           const MiddleNodes<Corners>& between = no_middle_nodes<Corners>()) {
    if (!middle.empty() || between != no_middle_nodes<Corners>()) {
      middle.resize(vertices.size(), no_middle_nodes<Corners>());
      middle.push_back(between);
    }
    vertices.push_back(v);
    label.push_back(number);
    group.push_back(where);
  }
  MiddleNodes<Corners> middle_of(std::size_t c) const {
    return middle.empty() ? no_middle_nodes<Corners>() : middle[c];
  }
};

/// How a format orders the nodes of a second-order cell's edges, which follow its corners: per edge of simplex_edges.
template <int Corners>
using EdgeOrder = std::array<int, Corners*(Corners - 1) / 2>;
inline constexpr EdgeOrder<2> line_edges{0};
inline constexpr EdgeOrder<3> triangle_edges{0, 2, 1};
inline constexpr EdgeOrder<4> gmsh_tetrahedron_edges{0, 2, 3, 1, 5, 4}, vtk_tetrahedron_edges{0, 2, 3, 1, 4, 5};

/// What the readers of all formats find, whatever the dimension.
struct MeshFileData {
  std::vector<Point<3>> points;
  FileCells<2> lines;
  FileCells<3> triangles;
  FileCells<4> tetrahedra;
};

/// Names of the physical groups that the cells of entity `group` belong to; `dimension` is that of the cells.
using GroupNames = std::function<std::vector<std::string>(int dimension, Index group)>;

/// The mesh of highest dimension, with the cells one dimension lower as its parts.
/// @param groups as read_any_mesh(), or null
AnyMesh make_mesh(MeshFileData data, const GroupNames& names, std::string_view place, FileGroups* groups);

}  // namespace signorini
