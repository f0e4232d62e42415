#pragma once
#include <functional>
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// One side of a contact between two bodies: the faces that may touch, and all of the body's, by their numbers in
/// Mesh::boundary, ascending.
struct BodyFaces {
  std::vector<Index> touching, all;
};

/// The point of a touching face that is deepest inside the other body.
template <int D>
struct Overlap {
  double depth = 0;  ///< behind the nearest touching face of the other body, less what is added; 0: nowhere
  Point<D> place{};
  Index slave_face = -1;  ///< the face that the point is on, or is nearest to
};

/// How deep two bodies overlap: where flat faces of one are cut off by those of the other one, at the corners of what
/// is inside and between them. Vertices need not be inside, and surfaces may coincide. Work is linear in the number of
/// faces, times a logarithm; nothing to speak of where the boxes of the bodies do not overlap.
/// @param points where the vertices of the mesh are, user's unit of length
/// @param added to the distance of the bodies at a place of one of the slave's faces; none: nothing
template <int D>
Overlap<D> find_overlap(const Mesh<D>& mesh, std::span<const Point<D>> points, const BodyFaces& slave,
                        const BodyFaces& master,
                        const std::function<double(const Point<D>& place, Index slave_face)>& added = {});

}  // namespace signorini
