#pragma once
#include "core/mesh/mesh.hpp"

namespace signorini {

/// The surface that a flat boundary face stands for, as seen from a point of the face.
template <int D>
struct SurfacePoint {
  double height = 0;  ///< of the surface over the face, along the direction looked in; user's unit of length
  Point<D> normal{};  ///< of the surface there, outwards, of length 1
};

/// Whether the mesh knows what a face stands for, a shape or a patch, and all of its vertices are on that. (Where
/// elements would have been inverted refinement leaves vertices off it.)
template <int D>
bool stands_for_surface(const Mesh<D>& mesh, Index face);

/// Of a face that stands for a surface: where the line through a point of the face meets that.
/// @param direction of the line, of length 1, within 60 degrees or so of the face's normal
template <int D>
SurfacePoint<D> surface_at(const Mesh<D>& mesh, Index face, const std::array<double, D>& barycentric,
                           const Point<D>& direction);

}  // namespace signorini
