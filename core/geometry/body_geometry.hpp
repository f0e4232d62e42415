#pragma once
#include "core/geometry/smooth_boundary.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini::geometry {

/// What the flat boundary faces of a mesh from a file stand for.
enum class Surfaces {
  automatic,  ///< shapes that the nodes are on up to the rounding of their digits; else curved elements where the mesh
              ///< has them, and elsewhere a smooth surface
  smooth,     ///< a smooth surface through the vertices
  fit,        ///< the nearest shapes; facets where none is near
  facets,     ///< themselves
};

/// How the boundary of a body from a file is read.
struct Reading {
  Surfaces surfaces = Surfaces::automatic;
  double crease = default_crease;  ///< radians
};

/// Gives the boundary of a coarsest mesh its curves and patches, which refinement puts new vertices on, and says in
/// `pieces` what each smooth piece is taken for. Vertices are moved onto shapes that are fitted to them, as far as no
/// element is turned inside out. Elements with several faces on one curve are divided.
/// @param crease angle in radians at which faces meet at an edge of the body
/// @param beyond planes that the body goes on beyond, mirrored, and has no faces on: its surface is smooth across them
template <int D>
void give_geometry(Mesh<D>& mesh, Surfaces surfaces, double crease = default_crease,
                   std::span<const Mirror> beyond = {});

}  // namespace signorini::geometry
