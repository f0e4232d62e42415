#pragma once
#include <string>
#include <vector>

#include "core/io/warning.hpp"
#include "core/mesh/mesh.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// Boundaries of bodies of a scene, where they were and where they are.
template <int D>
struct MovedBoundaries {
  Mesh<D> mesh;                 ///< points and boundary only
  std::vector<Point<D>> after;  ///< per point
  std::vector<std::string> body;
  std::vector<std::vector<Index>> faces;  ///< per body, of mesh.boundary

  /// A body.
  /// @param u displacements of the vertices of `of`, D each
  void add(const Mesh<D>& of, const std::string& name, const std::vector<Index>& faces_of_body,
           const std::vector<double>& u);
};

/// Bodies that no obstacle keeps apart, and that have moved into each other.
template <int D>
Warnings unheld_overlaps(const Scene& scene, const MovedBoundaries<D>& all);

}  // namespace signorini
