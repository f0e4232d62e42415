#pragma once
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "estimators/certificate/incidence.hpp"

namespace signorini {

/// A function that is quadratic in the simplices of a mesh: linear between vertices, and bubbles 4 phi_a phi_b of
/// edges.
struct QuadraticFunction {
  std::vector<double> at_vertex;  ///< B values each
  std::vector<double> of_edge;    ///< B coefficients each; empty: none, it is linear
};

/// A finite element function. Quadratic elements on straight edges are quadratic in their children; on curved ones the
/// function is the one with the same values at nodes whose second derivatives are those of the straight element.
/// @param u coefficients of the nodes, B each
template <int D, int B>
QuadraticFunction quadratic_function(const Nodes<D>& nodes, const Incidence<D>& incidence,
                                     const std::vector<double>& u);

/// The quadratic element whose child each simplex of the mesh is.
template <int D>
std::vector<Index> fathers(const Nodes<D>& nodes);

}  // namespace signorini
