#include "core/mesh/mirror.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"

namespace signorini {
namespace {

constexpr double single_precision = 1e-6;  // of the extent: vertices of files may be in single precision

template <int D>
bool face_lies_on(const Mesh<D>& mesh, const Face<D>& face, const Mirror& mirror) {
  return std::ranges::all_of(face.vertices, [&](Index v) { return lies_on<D>(mirror, mesh.points[v]); });
}

}  // namespace

std::string plane_name(const Mirror& mirror) { return fmt::format("{} = {:g}", axis_name(mirror.axis), mirror.at); }

template <int D>
void add_mirror(Mesh<D>& mesh, const Mirror& mirror, std::string_view place) {
  double low = mesh.points.front()[mirror.axis], high = low, extent = 0;
  for (int i = 0; i < D; ++i) {
    const auto [least, most] = std::ranges::minmax_element(mesh.points, {}, [i](const Point<D>& x) { return x[i]; });
    extent = std::max(extent, (*most)[i] - (*least)[i]);
    if (i == mirror.axis) low = (*least)[i], high = (*most)[i];
  }
  const double near = single_precision * extent;
  if (low < mirror.at - near && high > mirror.at + near)
    input_error(place, fmt::format("the body reaches from {:g} to {:g}, beyond the plane of symmetry {} on both sides; "
                                   "expected all of its mesh on one side",
                                   low, high, plane_name(mirror)));
  for (Point<D>& x : mesh.points)
    if (std::abs(x[mirror.axis] - mirror.at) <= near) x[mirror.axis] = mirror.at;
  if (std::ranges::none_of(mesh.boundary, [&](const Face<D>& face) { return face_lies_on(mesh, face, mirror); }))
    input_error(place, fmt::format("the body, from {:g} to {:g}, has no face on the plane of symmetry {}", low, high,
                                   plane_name(mirror)));
  mesh.mirrors.push_back(mirror);
}

template <int D>
void remove_faces_on_mirrors(Mesh<D>& mesh) {
  if (mesh.mirrors.empty()) return;
  std::vector<bool> kept;
  for (const Face<D>& face : mesh.boundary)
    kept.push_back(
        std::ranges::none_of(mesh.mirrors, [&](const Mirror& mirror) { return face_lies_on(mesh, face, mirror); }));
  keep_faces(mesh, kept);
}

template void add_mirror(Mesh<2>&, const Mirror&, std::string_view);
template void add_mirror(Mesh<3>&, const Mirror&, std::string_view);
template void remove_faces_on_mirrors(Mesh<2>&);
template void remove_faces_on_mirrors(Mesh<3>&);

}  // namespace signorini
