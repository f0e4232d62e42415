#pragma once
#include <optional>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/mesh/mesh.hpp"

/// Bodies of which one side of planes of symmetry is meshed: which faces go on beyond the planes.
namespace signorini {

/// A bit for each of Mesh::mirrors.
using Planes = unsigned;

/// All planes of a mesh.
template <int D>
Planes all_planes(const Mesh<D>& mesh) {
  return (1u << mesh.mirrors.size()) - 1;
}

/// The planes that a selection goes on beyond: by parts that have vertices on a plane, and by expressions that hold at
/// the images of the faces they pick; edges and points where they have a node on the plane. Without a selection all
/// planes are.
/// Error(Exit::input) where an expression holds at some of these images only.
template <int D>
Planes planes_across(const Nodes<D>& nodes, const std::optional<Selection>& on, double t);

/// The image of a direction.
template <int D>
Point<D> reflected_direction(const Mirror& mirror, Point<D> d) {
  d[mirror.axis] = -d[mirror.axis];
  return d;
}

}  // namespace signorini
