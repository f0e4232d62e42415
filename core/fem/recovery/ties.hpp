#pragma once
#include "core/fem/recovery/counterforces.hpp"

namespace signorini {

/// What ties exert on the nodes of slaves, by ascending node: what A x - b of the matrix before elimination leaves
/// along what they prescribe. The tangential parts are those across the mean normals of the slave's faces.
/// @param x solution in local coordinates
template <int D, int B>
std::vector<TieForce<B>> tie_forces(const Nodes<D>& nodes, const Model<B>& model,
                                    const Discretization<B>& discretization, const std::vector<double>& x);

/// What a bolt does.
struct BoltState {
  Index obstacle;         ///< its cut: number in Model::obstacles
  double force = 0;       ///< that it pulls by, of the part that is meshed; user's unit
  double shortening = 0;  ///< user's unit of length
  bool locked = false;
};

/// Of each cut with pretension.
/// @param ties tie_forces()
template <int D, int B>
std::vector<BoltState> bolts(const Model<B>& model, const Discretization<B>& discretization,
                             const std::vector<TieForce<B>>& ties, const std::vector<double>& x);

/// Nodes, area and total forces on slaves of each tie are added to what obstacles do.
template <int B>
void sum_up(const std::vector<TieForce<B>>& ties, std::vector<ContactSummary<B>>& obstacles);

}  // namespace signorini
