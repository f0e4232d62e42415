#include "core/io/mesh_file_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/mesh/build.hpp"

namespace signorini {
namespace {

template <int D>
Mesh<D> build(std::vector<Point<D>> points, FileCells<D + 1> cells, const FileCells<D>& faces, const GroupNames& names,
              std::string_view place) {
  RawMesh<D> raw{std::move(points), std::move(cells.vertices), std::move(cells.group), std::move(cells.label), {}};
  std::map<Index, std::vector<std::size_t>> groups_of;  // per entity, positions in raw.groups
  for (std::size_t f = 0; f < faces.vertices.size(); ++f) {
    const auto [entry, is_new] = groups_of.try_emplace(faces.group[f]);
    if (is_new)
      for (std::string& name : names(D - 1, faces.group[f])) {
        entry->second.push_back(raw.groups.size());
        raw.groups.push_back({std::move(name), {}});
      }
    for (const std::size_t g : entry->second) raw.groups[g].faces.push_back(faces.vertices[f]);
  }
  return build_mesh<D>(std::move(raw), place);
}

std::vector<Point<2>> flatten(const MeshFileData& data, std::string_view place) {
  std::vector<Point<2>> points;
  double low = infinity, high = -infinity, extent = 0;
  for (const Point<3>& p : data.points) points.push_back({p[0], p[1]});
  const Point<3>& origin = data.points[data.triangles.vertices[0][0]];
  for (const auto& triangle : data.triangles.vertices)
    for (const Index v : triangle) {
      const Point<3>& p = data.points[v];
      low = std::min(low, p[2]);
      high = std::max(high, p[2]);
      extent = std::max({extent, std::abs(p[0] - origin[0]), std::abs(p[1] - origin[1]), std::abs(p[2])});
    }
  if (high - low > 1e-10 * extent)
    input_error(place, fmt::format("found a surface in space, its triangles with z from {} to {}, and no tetrahedra; "
                                   "expected its volume meshed, or triangles in a plane z = const",
                                   low, high));
  return points;
}

}  // namespace

AnyMesh make_mesh(MeshFileData data, const GroupNames& names, std::string_view place) {
  if (!data.tetrahedra.vertices.empty())
    return build<3>(std::move(data.points), std::move(data.tetrahedra), data.triangles, names, place);
  if (data.triangles.vertices.empty()) input_error(place, "the mesh has neither triangles nor tetrahedra");
  std::vector<Point<2>> points = flatten(data, place);
  return build<2>(std::move(points), std::move(data.triangles), data.lines, names, place);
}

}  // namespace signorini
