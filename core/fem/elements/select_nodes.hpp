#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/fem/elements/integrate.hpp"
#include "core/fem/elements/select.hpp"
#include "core/mesh/mirror.hpp"

/// Selections of faces, edges and points.
namespace signorini {

/// A vertex of elements near a point.
struct NearVertex {
  Index node;
  double distance;
};

/// The vertex of the mesh that is nearest to the point of a selection: of the bodies that the selection's part is of,
/// if it has one. Midpoints of quadratic elements do not count. Error(Exit::input) if it is farther away than elements
/// around it are long.
template <int D>
NearVertex nearest_vertex(const Nodes<D>& nodes, const Selection& selection);

/// The nodes that a selection picks, ascending. Error(Exit::input) where there are none.
template <int D>
std::vector<Index> select_nodes(const Nodes<D>& nodes, const Selection& selection, double t);

/// The edges that faces of both parts of a selection have, by the vertices of their nodes of order P.
template <int P>
std::vector<std::array<Index, element_nodes<1, P>>> common_edges(const Nodes<3>& nodes, const Selection& selection);

/// The part of a point or an edge that belongs to the side of the planes of symmetry that is meshed: half of it for
/// each plane in which it lies, for the other side has as much.
/// @param points of the mesh, its ends
template <int D>
double share_of_side(const Mesh<D>& mesh, std::span<const Point<D>> points) {
  double share = 1;
  for (const Mirror& mirror : mesh.mirrors)
    if (std::ranges::all_of(points, [&](const Point<D>& x) { return lies_on<D>(mirror, x); })) share /= 2;
  return share;
}

/// Calls use(IntegrationPoint) on what a selection picks, see integrate_faces(). A point has the measure 1, of an
/// axisymmetric body that of its circle, as far as it belongs to the side of planes of symmetry that is meshed.
template <int D, int P, class Use>
void integrate_selection(const Nodes<D>& nodes, Plane plane, const Selection& selection, double t, bool constant,
                         const Use& use) {
  if (selection.picks_faces())
    return integrate_faces<D, P>(nodes, plane, select_faces(nodes.mesh(), selection, t), constant, use);
  if constexpr (D == 3)
    if (selection.other) {
      for (const auto& edge : common_edges<P>(nodes, selection)) {
        const std::array<Point<3>, 2> ends{nodes.mesh().points[edge[0]], nodes.mesh().points[edge[1]]};
        const auto measure = [share = share_of_side<3>(nodes.mesh(), ends)](const auto& corner, const Point<3>&) {
          return share * length<3>(difference<3>(corner[1], corner[0]));
        };
        integration::on_simplex<3, 1, P>(nodes, plane, constant, edge, measure, use);
      }
      return;
    }
  for (const Index p : select_nodes(nodes, selection, t)) {
    const Point<D> x = nodes.at(p);
    const double around = circumference<D>(plane, x);
    use(IntegrationPoint<D, 1>{x, {}, share_of_side<D>(nodes.mesh(), {&x, 1}) * (around > 0 ? around : 1), {p}, {1}});
  }
}

}  // namespace signorini
