#pragma once
#include <type_traits>
#include <vector>

#include "core/fem/recovery/contact.hpp"

namespace signorini {

/// A force that an obstacle exerts on a node, global coordinates.
template <int B>
struct NodalForce {
  Index node;
  Index obstacle;  ///< number in Model::obstacles
  std::array<double, B> force;
  std::array<double, B> tangential;       ///< along the surface, counted in `force`
  bool on_slave = false;                  ///< or on the master
  bool friction = false, sticks = false;  ///< of the slave's node, as ContactNode has them
};

/// What a tie exerts on a node of the slave.
template <int B>
struct TieForce : NodalForce<B> {
  double area = 0;  ///< of the node, as far as it is tied
};

/// What contact between bodies and ties exert on the masters: the force on a slave's node with the other sign, at the
/// nodes of the master that it is coupled to, as their unknowns are jumps. One entry per such pair of nodes. Of
/// quadratic elements some may be nodes of the slave, see MortarCoupling.
/// @param ties tie_forces()
template <int D, int B>
std::vector<NodalForce<B>> counterforces(const Nodes<D>& nodes, const Model<B>& model,
                                         const DiscreteProblem<B>& problem, const ContactState<B>& contact,
                                         const std::vector<TieForce<B>>& ties = {});

/// The sums of those on slaves, or on masters, per obstacle of the model; zero for obstacles that act on one body.
/// @param part what is summed up
template <int B>
using PartOfForce = std::type_identity_t<std::array<double, B> NodalForce<B>::*>;
template <int B>
std::vector<std::array<double, B>> totals(const std::vector<NodalForce<B>>& forces, std::size_t obstacles,
                                          bool on_slave = false, PartOfForce<B> part = &NodalForce<B>::force);

}  // namespace signorini
