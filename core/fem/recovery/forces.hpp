#pragma once
#include "core/fem/recovery/contact.hpp"

namespace signorini {

/// Total forces on a body, one entry per unknown of a vertex; for a scalar unknown sources and fluxes. At a solution
/// they sum to zero but for its algebraic error. Of an axisymmetric body the first entry is an integral of radial
/// forces, without a resultant: hoop stresses carry their sum.
template <int B>
struct Forces {
  /// What a fix exerts at a node.
  struct AtNode {
    Index node, fix;
    std::array<double, B> force;
  };

  std::vector<std::array<double, B>> applied;    ///< per load of the model
  std::vector<std::array<double, B>> reactions;  ///< per fix of the model
  std::vector<std::array<double, B>> contact;    ///< per obstacle of the model
  std::vector<std::array<double, B>> springs{};  ///< per spring of the model
  std::vector<AtNode> at_fixes{};                ///< of an elastic body: of these `reactions` are the sums
};

/// The reaction of a fix is what A x - b of the matrix before elimination leaves along the directions that it
/// prescribes, less the forces of obstacles there, see ContactNode. Where fixes prescribe one direction of a vertex, it
/// belongs to the one that holds (see collect_fixes()).
/// @param x solution in local coordinates
template <int B>
Forces<B> forces(const Model<B>& model, const Discretization<B>& discretization, const ContactState<B>& contact,
                 const std::vector<double>& x);

}  // namespace signorini
