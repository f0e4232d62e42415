#pragma once
#include <string_view>
#include <vector>

#include "core/fem/elements/element.hpp"
#include "core/fem/elements/nodes.hpp"

namespace signorini {

/// Where a point lies: a simplex of the mesh, or an element, and barycentric coordinates in it.
template <int D>
struct Place {
  Index element;
  std::array<double, D + 1> barycentric;
};

/// The simplex of a mesh around a point. A point outside the mesh is one beyond the nearest face, outside its simplex,
/// if it may lie between that and the curve that the face stands for: up to a shape, but for a thousandth of the face;
/// and up to h^2 / (2 R), four times the height of an arc over its chord, with the face's longest edge h and the
/// curve's radius R, or that of the faces around which it meets smoothly. Farther away it is an Error(Exit::input) that
/// names `origin`, the position and the distance.
template <int D>
Place<D> locate(const Mesh<D>& mesh, const Point<D>& point, std::string_view origin);

/// The same place in an element: of quadratic elements the one that the simplex is a part of, as it is curved.
template <int D>
Place<D> in_element(const Nodes<D>& nodes, const Place<D>& in_simplex);

/// The value of a finite element function, B per node, at a place in a simplex of the mesh.
template <int B, int D>
std::array<double, B> evaluate(const Nodes<D>& nodes, const Place<D>& in_simplex, const std::vector<double>& u) {
  std::array<double, B> value{};
  const Place<D> place = in_element(nodes, in_simplex);
  with_order(nodes, [&](auto order) {
    const auto node = nodes.of(nodes.template elements<order>()[place.element]);
    const auto values = basis<order>(place.barycentric);
    for (std::size_t a = 0; a < node.size(); ++a)
      for (int i = 0; i < B; ++i) value[i] += values[a] * u[Offset{node[a]} * B + i];
  });
  return value;
}

}  // namespace signorini
