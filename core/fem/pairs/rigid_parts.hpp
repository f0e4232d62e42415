#pragma once
#include <vector>

#include "core/fem/conditions/fixes.hpp"
#include "core/fem/conditions/paired_nodes.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/solver/jump_builder.hpp"

namespace signorini {

/// The unknowns of a part of the boundary that moves as a rigid body, u_p = q + theta x (p - point): its first carrier
/// holds q and its second one `length` times theta, in 2D in its first component. What is left of them, and all
/// unknowns x_p of the other nodes, are how far these are off that motion, and are prescribed to be zero. Of an
/// axisymmetric body, which moves along its axis alone, the displacement of the first carrier is q, and there is no
/// other one.
///
/// That takes no more than the change of basis which jumps between bodies are: constraints hold exactly, and loads,
/// levels and results go through what is there for these. Carriers are vertices of the coarsest mesh, and so the same
/// ones on all meshes.
/// @param parts their nodes may not have been added to `jumps` in another way
/// Error(Exit::input) for a part that meets another one.
template <int D>
std::vector<RigidNodes<D>> add_rigid_parts(const Nodes<D>& nodes, const Model<D>& model, JumpBuilder<D>& jumps);

/// Prescribes what is of a rigid part: all that is no motion, and of motions what its table does.
/// Error(Exit::input) for a fix that acts on a node of it.
/// @param fixes by ascending node
template <int D>
void hold(const Nodes<D>& nodes, const Model<D>& model, const std::vector<RigidNodes<D>>& parts,
          std::vector<FixedDirections<D>>& fixes);

/// Adds the forces and torques on rigid parts to a load vector: such ones at the carriers as have the same work.
template <int D>
void add_rigid_loads(const Nodes<D>& nodes, const Model<D>& model, const PairedBodies<D>& pairs,
                     std::vector<double>& load);

}  // namespace signorini
