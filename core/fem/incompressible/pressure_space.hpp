#pragma once
#include <array>
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/material.hpp"

namespace signorini {

/// The pressure of nearly incompressible material, as unknowns beside the displacements:
///
///     stress = lambda0 tr(strain) I + 2 mu strain + p I,    p = (lambda - lambda0) tr(strain) in the mean,
///
/// without thermal strains, tested with the functions that p is made of. lambda0 is moderate (lambda_of_displacements),
/// so that the matrix of the displacements is no worse than that of any material. p is positive where the material is
/// stretched.
///
/// Elements are the families of a mesh. On each p is linear (continuous within a material) or constant, and the
/// displacements are quadratic (Taylor and Hood's element), or linear on the children of the family. Elements without a
/// pressure of their own (has_pressure()) have no unknowns.
template <int D>
struct PressureSpace {
  Pressure kind = Pressure::none;
  /// Per family the unknowns of its corners, which are one where they are constant; -1: none.
  std::vector<std::array<Index, D + 1>> unknown;
  Index size = 0;
  std::vector<Index> material;  ///< per unknown, numbered from 0
  Index materials = 0;

  std::vector<Offset> row = {0};  ///< size + 1: C, the integrals of p-function times divergence
  std::vector<Index> column;      ///< nodes
  std::vector<double> value;      ///< D per column

  std::vector<Offset> mass_row = {0};  ///< size + 1: products of p-functions
  std::vector<Index> mass_column;
  std::vector<double> compliance;  ///< their integrals over lambda - lambda0
  std::vector<double> response;    ///< what stands for C A^-1 C': those over what the displacements resist with

  /// p at a point of a family.
  double at(const std::vector<double>& p, std::size_t family, const std::array<double, D + 1>& barycentric) const {
    double sum = 0;
    if (unknown[family][0] < 0) return sum;
    for (int a = 0; a <= D; ++a) sum += barycentric[a] * p[unknown[family][a]];
    return sum;
  }
};

/// @param nodes on a mesh with families
template <int D>
PressureSpace<D> pressure_space(const Nodes<D>& nodes, const Model<D>& model);

/// Per unknown the integral of its function times the thermal part of tr(strain), to which p does not respond. Empty
/// where the model has none.
/// @param space pressure_space() of both
template <int D>
std::vector<double> thermal_volume(const Nodes<D>& nodes, const Model<D>& model, const PressureSpace<D>& space);

/// The pressure of a coarser mesh on the next finer one, both refined ones.
/// @param refinement from the coarse mesh to the fine one
template <int D>
std::vector<double> prolongate(const PressureSpace<D>& coarse, const Mesh<D>& coarse_mesh, const std::vector<double>& p,
                               const Refinement& refinement, const PressureSpace<D>& fine, const Mesh<D>& fine_mesh);

}  // namespace signorini
