#pragma once
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/incompressible/pressure_space.hpp"
#include "core/fem/model/model.hpp"

namespace signorini {

/// A symmetric stress tensor in the order of VTK: xx, yy, zz, xy, yz, xz.
using Stress = std::array<double, 6>;

/// A pressure with unknowns of its own; null: none.
template <int D>
struct OwnPressure {
  const PressureSpace<D>* space = nullptr;
  const std::vector<double>* values = nullptr;
};

/// The stress at the centroid of every element; in plane strain zz is what holds the body flat. Of an axisymmetric body
/// xx is the radial, yy the axial and zz the hoop stress.
/// @param u displacements in global coordinates, D per node
/// @param pressure of quadratic elements alone
template <int D>
std::vector<Stress> element_stress(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u,
                                   const OwnPressure<D>& pressure = {});

/// At each vertex of the mesh, recovered (Zienkiewicz and Zhu, The superconvergent patch recovery, 1992): stresses of
/// finite elements are best at some points inside, and jump between elements. Polynomials of the elements' degree are
/// fitted by least squares to what the elements around a node have at these points. At the boundary, where values
/// outside of the samples are asked for, quadratic ones are fitted over two layers of elements; for linear elements to
/// the nodes inside. Where materials meet each has its own fit as at a boundary, and the mean of them is given. Where
/// too few elements are around linear polynomials take their place, then the mean of the samples.
///
/// Errors: O(h^2) of linear elements, O(h^3) of quadratic ones on straight edges, up to the boundary, where the
/// solution is smooth.
/// @param u likewise
template <int D>
std::vector<Stress> nodal_stress(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u,
                                 const OwnPressure<D>& pressure = {});

double von_mises(const Stress& stress);

}  // namespace signorini
