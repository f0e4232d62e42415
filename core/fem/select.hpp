#pragma once
#include <vector>

#include "core/fem/model.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// Some faces of the boundary together with their vertices.
template <int D>
struct Surface {
  std::vector<Index> faces;     ///< numbers in Mesh::boundary, ascending
  std::vector<Index> vertices;  ///< of these faces, ascending
  std::vector<Offset> first;    ///< vertices + 1: where the faces around each vertex begin in `around`
  std::vector<Index> around;    ///< numbers in Mesh::boundary, of these faces only
};

/// The boundary faces of the named part all of whose vertices satisfy the expression; either may be missing. Faces of
/// the coarsest mesh are picked, those of finer meshes inherit it: all levels agree. The expression sees the normal of
/// the face. No face at all is an Error(Exit::input) that names the selection's origin.
template <int D>
std::vector<Index> select_faces(const Mesh<D>& mesh, const Selection& selection, double t);

template <int D>
Surface<D> surface(const Mesh<D>& mesh, std::vector<Index> faces);

/// All of the boundary.
template <int D>
Surface<D> surface(const Mesh<D>& mesh);

/// Outer unit normals at the vertices of a surface: the mean over its faces weighted by their measure; zero where the
/// normals cancel.
template <int D>
std::vector<Point<D>> vertex_normals(const Mesh<D>& mesh, const Surface<D>& surface);

/// Integrals of the hat functions over a surface, one per vertex of it: they sum to its measure.
template <int D>
std::vector<double> vertex_areas(const Mesh<D>& mesh, const Surface<D>& surface);

/// Integrals of the hat functions over the body, one per vertex.
template <int D>
std::vector<double> vertex_volumes(const Mesh<D>& mesh);

}  // namespace signorini
