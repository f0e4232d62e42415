#pragma once
#include <vector>

#include "core/fem/elements/integrate.hpp"
#include "core/fem/elements/select.hpp"

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

/// Calls use(IntegrationPoint) on what a selection picks, see integrate_faces(). A point has the measure 1, of an
/// axisymmetric body that of its circle.
template <int D, int P, class Use>
void integrate_selection(const Nodes<D>& nodes, Plane plane, const Selection& selection, double t, bool constant,
                         const Use& use) {
  if (selection.picks_faces())
    return integrate_faces<D, P>(nodes, plane, select_faces(nodes.mesh(), selection, t), constant, use);
  if constexpr (D == 3)
    if (selection.other) {
      const auto measure = [](const auto& corner, const Point<3>&) {
        return length<3>(difference<3>(corner[1], corner[0]));
      };
      for (const auto& edge : common_edges<P>(nodes, selection))
        integration::on_simplex<3, 1, P>(nodes, plane, constant, edge, measure, use);
      return;
    }
  for (const Index p : select_nodes(nodes, selection, t)) {
    const double around = circumference<D>(plane, nodes.at(p));
    use(IntegrationPoint<D, 1>{nodes.at(p), {}, around > 0 ? around : 1, {p}, {1}});
  }
}

}  // namespace signorini
