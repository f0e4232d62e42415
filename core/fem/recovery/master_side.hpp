#pragma once
#include "core/fem/recovery/counterforces.hpp"
#include "core/fem/recovery/pressure_recovery.hpp"

namespace signorini {

/// The masters of a model's obstacles between bodies.
template <int B>
struct MasterSide {
  std::vector<ContactNode<B>> nodes;         ///< per obstacle by ascending node
  std::vector<RecoveredPressure> pressures;  ///< per obstacle of the model
  std::vector<MasterMeans> seen;             ///< likewise: what the nodes see of the slave
};

/// What contact between bodies does at the nodes of the masters that a slave is in front of, as ContactNode has it for
/// the slave's: forces and pressures are those of the counterforces, gaps the distances that displacements leave.
/// @param u global coordinates, B per node
template <int D, int B>
MasterSide<B> master_side(const Nodes<D>& nodes, const Model<B>& model, const std::vector<NodalForce<B>>& counterforces,
                          const std::vector<double>& u);

}  // namespace signorini
