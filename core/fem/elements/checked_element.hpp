#pragma once
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/fem/elements/element.hpp"

namespace signorini {

[[noreturn]] inline void refuse_element(int dimension, double measure, const Site& where, const std::string& origin) {
  input_error(origin, fmt::format("element with {} {} around ({}, {}, {}), expected a positive one",
                                  dimension == 2 ? "area" : "volume", measure, where.x[0], where.x[1], where.x[2]));
}

/// Error(Exit::input) at `origin` that says where the element is, unless its measure is positive.
template <int D>
inline LinearElement<D> checked_element(const Mesh<D>& mesh, const Simplex<D>& vertices, const std::string& origin) {
  const LinearElement<D> out = linear_element(mesh, vertices);
  if (out.measure > 0) [[likely]]
    return out;
  refuse_element(D, out.measure, site<D>(centroid<D>(mesh, vertices), 0), origin);
}

/// The flat element that one of order P is like at a point, likewise.
template <int D, int P>
inline LinearElement<D> checked_element(const ElementMap<D, D, P>& map, const std::array<double, D + 1>& barycentric,
                                        const std::string& origin) {
  const LinearElement<D> out = linear_element(map.flat(barycentric));
  if (out.measure > 0) [[likely]]
    return out;
  refuse_element(D, out.measure, site<D>(map(barycentric), 0), origin);
}

/// Pairs of different nodes that an element has in common, about: by Euler's formula, up to the number of handles. Of
/// quadratic elements those in elements, faces and edges, which are cut into 2^D, 2^(D-1) and 2 by the mesh.
template <int D>
std::size_t estimated_pairs(const Nodes<D>& nodes) {
  const Mesh<D>& mesh = nodes.mesh();
  const std::size_t elements = mesh.elements.size(), faces = mesh.boundary.size();
  if (nodes.order() == 1) return D == 2 ? (3 * elements + faces) / 2 : mesh.points.size() + elements + faces / 2;
  const std::size_t families = mesh.families.size(), sides = ((D + 1) * families + (faces >> (D - 1))) / 2;
  if (D == 2) return 3 * sides + 6 * families;
  const std::size_t edges = (mesh.points.size() + families + (faces >> 3)) / 2;
  return 3 * edges + 6 * sides + 3 * families;
}

}  // namespace signorini
