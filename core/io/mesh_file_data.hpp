#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/mesh_file.hpp"

namespace signorini {

/// Cells of one shape as a file gives them, by vertices counted from 0.
template <int Corners>
struct FileCells {
  std::vector<std::array<Index, Corners>> vertices;
  std::vector<Offset> label;  ///< number in the file
  std::vector<Index> group;   ///< geometric entity or group it belongs to, counted from 0

  void add(const std::array<Index, Corners>& v, Offset number, Index where) {
    vertices.push_back(v);
    label.push_back(number);
    group.push_back(where);
  }
};

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
