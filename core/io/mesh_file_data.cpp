#include "core/io/mesh_file_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/mesh/build.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

/// The numbers of the cells by the names of their groups.
template <int Corners>
std::map<std::string, std::vector<Index>> by_name(const FileCells<Corners>& cells, const GroupNames& names) {
  std::map<Index, std::vector<Index>> of_entity;
  for (std::size_t c = 0; c < cells.group.size(); ++c) of_entity[cells.group[c]].push_back(static_cast<Index>(c));
  std::map<std::string, std::vector<Index>> all;
  for (const auto& [entity, numbers] : of_entity)
    for (const std::string& name : names(Corners - 1, entity))
      all[name].insert(all[name].end(), numbers.begin(), numbers.end());
  return all;
}

template <int D>
std::size_t count_distinct(std::vector<std::array<Index, D>> faces) {
  for (auto& face : faces) face = sorted(face);
  std::ranges::sort(faces);
  return static_cast<std::size_t>(std::unique(faces.begin(), faces.end()) - faces.begin());
}

/// Groups with faces that did not become boundary faces of the mesh.
template <int D>
std::vector<FileGroups::OffBoundary> off_boundary(const std::vector<FaceGroup<D>>& groups, const Mesh<D>& mesh) {
  std::map<std::string, std::vector<std::array<Index, D>>> faces;
  for (const FaceGroup<D>& group : groups)
    faces[group.name].insert(faces[group.name].end(), group.faces.begin(), group.faces.end());
  std::vector<FileGroups::OffBoundary> found;
  for (auto& [name, all] : faces) {
    const auto part = std::ranges::find(mesh.parts, name, &Part::name);
    const std::size_t kept = part == mesh.parts.end() ? 0 : part->faces.size();
    if (all.size() == kept) continue;
    if (const std::size_t given = count_distinct<D>(std::move(all)); given > kept)
      found.push_back({name, given, given - kept});
  }
  return found;
}

template <int D>
Mesh<D> build(std::vector<Point<D>> points, FileCells<D + 1> cells, const FileCells<D>& faces, const GroupNames& names,
              std::string_view place, FileGroups* file_groups) {
  if (file_groups) file_groups->of_elements = by_name(cells, names);
  RawMesh<D> raw{std::move(points), std::move(cells.vertices), std::move(cells.middle), std::move(cells.label), {}};
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
  if (!file_groups) return build_mesh<D>(std::move(raw), place);
  const auto groups = raw.groups;
  Mesh<D> mesh = build_mesh<D>(std::move(raw), place);
  file_groups->off_boundary = off_boundary(groups, mesh);
  return mesh;
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
    input_error(place,
                fmt::format("found a surface in space, its triangles with z from {} to {}, and no tetrahedra; "
                            "expected its volume meshed, and in a physical group where faces are in one (Gmsh saves "
                            "what is in groups only), or triangles in a plane z = const",
                            low, high));
  return points;
}

}  // namespace

AnyMesh make_mesh(MeshFileData data, const GroupNames& names, std::string_view place, FileGroups* groups) {
  if (!data.tetrahedra.vertices.empty())
    return build<3>(std::move(data.points), std::move(data.tetrahedra), data.triangles, names, place, groups);
  if (data.triangles.vertices.empty()) input_error(place, "the mesh has neither triangles nor tetrahedra");
  std::vector<Point<2>> points = flatten(data, place);
  return build<2>(std::move(points), std::move(data.triangles), data.lines, names, place, groups);
}

}  // namespace signorini
