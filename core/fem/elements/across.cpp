#include "core/fem/elements/across.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select_nodes.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/mirror.hpp"

namespace signorini {
namespace {

template <int D>
bool touches_plane(const Mesh<D>& mesh, const std::vector<Index>& faces, const Mirror& mirror) {
  return std::ranges::any_of(faces, [&](Index f) {
    return std::ranges::any_of(mesh.boundary[f].vertices, [&](Index v) { return lies_on<D>(mirror, mesh.points[v]); });
  });
}

/// Whether an expression holds at the images of the faces of the coarsest mesh where it holds: of all, of none, else an
/// error.
template <int D>
bool holds_beyond(const Mesh<D>& mesh, const std::vector<Index>& faces, const Selection& on, const Mirror& mirror,
                  double t) {
  const Index children = faces_per_coarsest(mesh);
  Index there = 0, count = 0;
  for (std::size_t k = 0; k < faces.size(); k += static_cast<std::size_t>(children)) {
    const auto corners = points_of(mesh, coarsest_face(mesh, faces[k] / children));
    Point<D> normal = area_normal(corners);
    normalise(normal);
    const Point<D> image = reflected_direction<D>(mirror, normal);
    ++count;
    there += std::ranges::all_of(
        corners, [&](const Point<D>& x) { return (*on.where)(site<D>(reflected<D>(mirror, x), t, image)) != 0; });
  }
  if (there != 0 && there != count)
    input_error(on.origin,
                fmt::format("'{}' picks {} faces of the coarsest mesh, and holds on {} of their images beyond "
                            "the plane of symmetry {}; expected all, or none",
                            on.where->text(), count, there, plane_name(mirror)));
  return there == count;
}

}  // namespace

template <int D>
Planes planes_across(const Nodes<D>& nodes, const std::optional<Selection>& on, double t) {
  const Mesh<D>& mesh = nodes.mesh();
  if (!on) return all_planes(mesh);
  Planes out = 0;
  if (!on->picks_faces()) {
    const std::vector<Index> picked = select_nodes(nodes, *on, t);
    for (std::size_t m = 0; m < mesh.mirrors.size(); ++m)
      if (std::ranges::any_of(picked, [&](Index p) { return lies_on<D>(mesh.mirrors[m], nodes.at(p)); }))
        out |= 1u << m;
    return out;
  }
  const std::vector<Index> faces = select_faces(mesh, *on, t);
  for (std::size_t m = 0; m < mesh.mirrors.size(); ++m) {
    const Mirror& mirror = mesh.mirrors[m];
    const bool part_goes_on =
        !on->part || *on->part == "boundary" || touches_plane(mesh, faces_of(mesh, *on->part, on->origin), mirror);
    if (part_goes_on && (!on->where || holds_beyond(mesh, faces, *on, mirror, t))) out |= 1u << m;
  }
  return out;
}

template Planes planes_across(const Nodes<2>&, const std::optional<Selection>&, double);
template Planes planes_across(const Nodes<3>&, const std::optional<Selection>&, double);

}  // namespace signorini
