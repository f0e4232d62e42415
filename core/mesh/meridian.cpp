#include "core/mesh/meridian.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"

namespace signorini {
namespace {

constexpr double rounding = 1e-9;  // of the largest radius

void move_onto_axis(Mesh<2>& mesh, std::string_view place) {
  double largest = 0;
  for (const Point<2>& x : mesh.points) largest = std::fmax(largest, x[0]);
  for (Point<2>& x : mesh.points) {
    if (std::fabs(x[0]) <= rounding * largest) x[0] = 0;
    if (!(x[0] >= 0))
      input_error(place, fmt::format("an axisymmetric body has a vertex at ({}, {}), expected r >= 0 everywhere: x is "
                                     "the radius, and only that half of the section is meshed",
                                     x[0], x[1]));
  }
}

}  // namespace

void read_as_meridian(Mesh<2>& mesh, std::string_view place) {
  move_onto_axis(mesh, place);
  std::vector<Index> number(mesh.boundary.size(), -1);
  std::vector<Face<2>> kept;
  for (std::size_t f = 0; f < number.size(); ++f) {
    const auto [a, b] = mesh.boundary[f].vertices;
    if (mesh.points[a][0] == 0 && mesh.points[b][0] == 0) continue;
    number[f] = static_cast<Index>(kept.size());
    kept.push_back(mesh.boundary[f]);
  }
  mesh.boundary = std::move(kept);
  for (Part& part : mesh.parts) {
    for (Index& face : part.faces) face = number[face];
    std::erase(part.faces, -1);
  }
}

}  // namespace signorini
