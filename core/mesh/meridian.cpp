#include "core/mesh/meridian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/mirror.hpp"

namespace signorini {
namespace {

constexpr double off_axis = 1e-9;  // of the largest radius

void move_onto_axis(Mesh<2>& mesh, std::string_view place) {
  double largest = 0;
  for (const Point<2>& x : mesh.points) largest = std::fmax(largest, x[0]);
  for (Point<2>& x : mesh.points) {
    if (std::fabs(x[0]) <= off_axis * largest) x[0] = 0;
    if (!(x[0] >= 0))
      input_error(place, fmt::format("an axisymmetric body has a vertex at ({}, {}), expected r >= 0 everywhere: x is "
                                     "the radius, and only that half of the section is meshed",
                                     x[0], x[1]));
  }
}

}  // namespace

void read_as_meridian(Mesh<2>& mesh, std::string_view place) {
  move_onto_axis(mesh, place);
  std::vector<bool> kept;
  for (const Face<2>& face : mesh.boundary)
    kept.push_back(
        !std::ranges::all_of(face.vertices, [&](Index v) { return lies_on<2>({.axis = 0, .at = 0}, mesh.points[v]); }));
  keep_faces(mesh, kept);
}

}  // namespace signorini
