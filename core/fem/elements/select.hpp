#pragma once
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"

namespace signorini {

/// Some faces of the boundary together with their nodes. Of quadratic elements these are the faces of the mesh, which
/// cut those of the elements.
template <int D>
struct Surface {
  std::vector<Index> faces;   ///< numbers in Mesh::boundary, ascending
  std::vector<Index> nodes;   ///< of these faces, ascending
  std::vector<Offset> first;  ///< nodes + 1: where the faces around each node begin in `around`
  std::vector<Index> around;  ///< numbers in Mesh::boundary, of these faces only
};

/// The boundary faces of the named part all of whose vertices satisfy the expression; either may be missing. Faces of
/// the coarsest mesh are picked, those of finer meshes inherit it: all levels agree. The expression sees the normal of
/// the face. No face at all is an Error(Exit::input) that names the selection's origin.
template <int D>
std::vector<Index> select_faces(const Mesh<D>& mesh, const Selection& selection, double t);

template <int D>
Surface<D> surface(const Nodes<D>& nodes, std::vector<Index> faces);

/// All of the boundary.
template <int D>
Surface<D> surface(const Nodes<D>& nodes);

/// Outer unit normals at the nodes of a surface: the mean over its faces weighted by their measure; zero where the
/// normals cancel.
template <int D>
std::vector<Point<D>> node_normals(const Nodes<D>& nodes, const Surface<D>& surface);

/// Integrals of the basis functions over a surface, one per node of it: they are positive and sum to its measure.
/// Of an axisymmetric body over what the surface stands for, here and below.
template <int D>
std::vector<double> node_areas(const Nodes<D>& nodes, const Surface<D>& surface, Plane plane = Plane::strain);

/// The measure of a face of the mesh. Those of a curved quadratic element divide that of its own face as flat ones do.
template <int D>
double face_measure(const Nodes<D>& nodes, Index face);

/// The part of a node in the measure of a face of the mesh that it lies on: what adds up to that integral.
template <int D>
double face_share(const Nodes<D>& nodes, Index face, Index node, Plane plane = Plane::strain);

/// The node's basis function on a face that it lies on, as weights of points: they sum to one, and may be negative.
template <int D>
struct SharePoint {
  Point<D> at;
  double weight;
};
template <int D>
std::vector<SharePoint<D>> share_points(const Nodes<D>& nodes, Index face, Index node, Plane plane = Plane::strain);

/// Integrals of the basis functions over the body, one per node. (The functions of curved elements count by their
/// mean.)
template <int D>
std::vector<double> node_volumes(const Nodes<D>& nodes, Plane plane = Plane::strain);

}  // namespace signorini
