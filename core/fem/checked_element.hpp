#pragma once
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/fem/element.hpp"

namespace signorini {

/// Error(Exit::input) at `origin` that says where the element is, unless its measure is positive.
template <int D>
inline LinearElement<D> checked_element(const Mesh<D>& mesh, const Simplex<D>& vertices, const std::string& origin) {
  const LinearElement<D> out = linear_element(mesh, vertices);
  if (out.measure > 0) [[likely]]
    return out;
  const Site where = site<D>(centroid<D>(mesh, vertices), 0);
  input_error(origin, fmt::format("element with {} {} around ({}, {}, {}), expected a positive one",
                                  D == 2 ? "area" : "volume", out.measure, where.x[0], where.x[1], where.x[2]));
}

/// Euler's formula, up to the number of handles.
template <int D>
std::size_t estimated_edges(const Mesh<D>& mesh) {
  const std::size_t elements = mesh.elements.size(), faces = mesh.boundary.size();
  return D == 2 ? (3 * elements + faces) / 2 : mesh.points.size() + elements + faces / 2;
}

}  // namespace signorini
