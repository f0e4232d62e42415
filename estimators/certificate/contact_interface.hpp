#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/fem/model/model.hpp"
#include "core/sdk/friction.hpp"
#include "estimators/certificate/incidence.hpp"
#include "estimators/certificate/reasons.hpp"

namespace signorini {

/// Where a face of one body lies in front of one of the other: a simplex of what both meshes cut the interface into.
template <int D>
struct FacingPiece {
  Index slave, master;  ///< outer faces, numbers in Mesh::boundary, then in TrueProblem::outer
  std::array<std::array<double, D>, D> on_slave, on_master;  ///< of each corner, for the vertices of face_vertices()
  std::array<double, D> gap;                                 ///< at the corners
  double measure;
};

/// The flat faces along which two bodies may touch: normal . (u_slave - u_master) <= gap.
template <int D>
struct ContactInterface {
  Point<D> normal{};  ///< outer one of the slave
  std::vector<FacingPiece<D>> pieces;
  std::vector<FrictionLaw> law;  ///< per vertex, of the slave's per area; empty: no friction
};

/// Of an obstacle between two bodies.
/// @param reasons is told of what is not covered: faces that are not flat, or not parallel; friction that is not linear
template <int D>
ContactInterface<D> contact_interface(const Mesh<D>& mesh, const Model<D>& model, const ObstacleTerm<D>& term,
                                      Reasons& reasons);

}  // namespace signorini
