#include "core/mesh/build.hpp"

#include <algorithm>

#include "core/mesh/simplex.hpp"
#include "core/mesh/validate.hpp"

namespace signorini {
namespace {

template <int D>
void orient(RawMesh<D>& raw) {
  for (auto& element : raw.elements)
    if (relative_volume<D>(corners<D>(raw.points, element)) < 0) flip<D>(element);
}

template <int D>
void drop_unused_vertices(RawMesh<D>& raw) {
  std::vector<Index> number(raw.points.size(), -1);
  for (const auto& element : raw.elements)
    for (const Index v : element) number[v] = 0;
  Index used = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] == 0) {
      raw.points[used] = raw.points[v];
      number[v] = used++;
    }
  if (static_cast<std::size_t>(used) == raw.points.size()) return;

  raw.points.resize(used);
  for (auto& element : raw.elements)
    for (Index& v : element) v = number[v];
  for (FaceGroup<D>& group : raw.groups) {
    for (auto& face : group.faces)
      for (Index& v : face) v = number[v];
    std::erase_if(group.faces,
                  [](const auto& face) { return std::ranges::any_of(face, [](Index v) { return v < 0; }); });
  }
}

}  // namespace

template <int D>
Mesh<D> build_mesh(RawMesh<D> raw, std::string_view place) {
  drop_unused_vertices(raw);
  orient(raw);
  Mesh<D> mesh;
  mesh.points = std::move(raw.points);
  mesh.elements = std::move(raw.elements);
  validate(mesh, place, raw.label);
  mesh.boundary = find_boundary<D>(mesh.vertices(), mesh.elements);
  attach_parts(mesh, raw.groups);
  return mesh;
}

template Mesh<2> build_mesh(RawMesh<2>, std::string_view);
template Mesh<3> build_mesh(RawMesh<3>, std::string_view);

}  // namespace signorini
