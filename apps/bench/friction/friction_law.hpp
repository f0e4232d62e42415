#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini::bench {

/// A plane at rest with friction against a part of a body.
template <int D>
struct RoughPlane {
  std::string part;
  Point<D> point, normal;  ///< the latter of length 1, towards the body
  double friction;
};

/// A traction on a part of a body, constant on it.
template <int D>
struct Traction {
  std::string part;
  Point<D> value;
};

/// How far displacements are from Coulomb's law. Both are relative, and zero for an exact solution.
struct LawViolation {
  double force = 0;        ///< over the largest force that a plane exerts at a vertex
  double penetration = 0;  ///< over the largest displacement
  int sticking = 0, slipping = 0, open = 0;
  double worst() const;
};

/// Judges displacements by themselves: of the solver it takes neither matrices nor forces nor sets. What planes and
/// fixes exert is what linear elements of a homogeneous, isotropic body (plane strain) demand for balance.
/// @param u, last B = D per vertex; `last` after the step before
/// @param fixed parts that are held, where any force may act
template <int D>
LawViolation law_violation(const Mesh<D>& mesh, double young, double poisson, const std::vector<RoughPlane<D>>& planes,
                           const std::vector<Traction<D>>& loads, const std::vector<std::string>& fixed,
                           const std::vector<double>& u, const std::vector<double>& last);

}  // namespace signorini::bench
