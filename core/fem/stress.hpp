#pragma once
#include <vector>

#include "core/fem/model.hpp"
#include "core/fem/nodes.hpp"
#include "core/fem/pressure_space.hpp"

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

/// At each vertex of the mesh the mean of what the elements around it have there, weighted by their measure.
/// @param u likewise
template <int D>
std::vector<Stress> nodal_stress(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u,
                                 const OwnPressure<D>& pressure = {});

double von_mises(const Stress& stress);

}  // namespace signorini
