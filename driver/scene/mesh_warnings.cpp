#include "driver/scene/mesh_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/io/warning_kinds.hpp"
#include "core/mesh/hanging.hpp"
#include "core/mesh/hinges.hpp"
#include "driver/scene/numbers.hpp"

namespace signorini {
namespace {

template <int D, std::size_t N>
std::string points(const Mesh<D>& mesh, const std::array<Index, N>& vertices) {
  std::string all;
  for (const Index v : vertices)
    all += fmt::format("{}({})", all.empty() ? "" : " - ", fmt::join(mesh.points[v], ", "));
  return all;
}

std::string and_others(std::size_t count) { return count > 1 ? fmt::format(", and at {} more", count - 1) : ""; }

template <int D>
void add_joints(const Mesh<D>& mesh, const std::string& place, Warnings& warnings) {
  const Hinges hinges = find_hinges(mesh);
  if (const auto& all = hinges.vertices; !all.empty())
    warnings.push_back(
        warning<"hinge">(place, "vertex at " + points(mesh, std::array{all[0]}), and_others(all.size())));
  if (const auto& all = hinges.edges; !all.empty())
    warnings.push_back(warning<"hinge">(place, "edge " + points(mesh, all[0]), and_others(all.size())));
  if (const auto all = find_hanging_vertices(mesh); !all.empty())
    warnings.push_back(warning<"torn">(place, points(mesh, std::array{all[0].vertex}),
                                       (D == 2 ? "edge " : "face ") + points(mesh, mesh.boundary[all[0].face].vertices),
                                       and_others(all.size())));
}

/// Of the scene's fixes, loads, springs and obstacles.
std::vector<Selection> selections(const Scene& scene, const Scene::Body& body) {
  std::vector<Selection> all;
  for (const int k : numbers_of(scene.fixes, body)) all.push_back(scene.fixes[k].on);
  for (const int k : numbers_of(scene.rigids, body)) all.push_back(scene.rigids[k].on);
  for (const int k : numbers_of(scene.loads, body))
    if (scene.loads[k].on) all.push_back(*scene.loads[k].on);
  for (const int k : numbers_of(scene.springs, body)) all.push_back(scene.springs[k].on);
  for (const int k : numbers_of(scene.obstacles, body))
    if (scene.obstacles[k].on) all.push_back(*scene.obstacles[k].on);
  return all;
}

}  // namespace

template <int D>
Warnings mesh_warnings(const Mesh<D>& mesh, const FileGroups& groups, const std::string& place) {
  Warnings warnings;
  for (const auto& [name, faces, elsewhere] : groups.off_boundary)
    warnings.push_back(warning<"group-inside">(place, elsewhere, faces, D == 2 ? "edges" : "faces", name));
  add_joints(mesh, place, warnings);
  return warnings;
}

template <int D>
void refuse_lost_groups(const Scene& scene, const Scene::Body& body, const Mesh<D>& mesh, const FileGroups& groups) {
  std::vector<std::string> parts{"boundary"};
  for (const Part& part : mesh.parts) parts.push_back(part.name);
  for (const Selection& selection : selections(scene, body)) {
    if (!selection.part || std::ranges::count(parts, *selection.part) > 0) continue;
    if (groups.of_elements.contains(*selection.part))
      input_error(selection.origin,
                  fmt::format("'{}' is a physical group of {}, expected one of boundary {} (the parts "
                              "are: {})",
                              *selection.part, D == 2 ? "triangles" : "tetrahedra", D == 2 ? "edges" : "faces",
                              fmt::join(parts, ", ")));
    for (const auto& group : groups.off_boundary)
      if (group.name == *selection.part)
        input_error(selection.origin,
                    fmt::format("no {} of the physical group '{}' is on the boundary (the parts are: {})",
                                D == 2 ? "edge" : "face", group.name, fmt::join(parts, ", ")));
  }
}

#define SIGNORINI_INSTANTIATE(D)                                                          \
  template Warnings mesh_warnings(const Mesh<D>&, const FileGroups&, const std::string&); \
  template void refuse_lost_groups(const Scene&, const Scene::Body&, const Mesh<D>&, const FileGroups&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
