#pragma once
#include <map>
#include <vector>

#include "core/fem/conditions/fixes.hpp"
#include "core/fem/conditions/paired_nodes.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/solver/jump_builder.hpp"

/// Bolts: the shank is cut, and its two ends are tied, but for one length by which they are all pulled into each other
/// along the cut's normal n. The displacements of the slave's nodes p are those of the master and n times that length,
/// which is an unknown of one of them, the carrier c:
///
///     u_p = x_p + sum_q W_pq u_q + d_p n n' x_c.
///
/// Rows W sum to one, and d_p is the sum of their weights at nodes of the master: one, but beside nodes of the slave
/// that are left out, see MortarCoupling.
///
/// The force of the bolt is what has work along it. Once it is locked, the length is prescribed.
namespace signorini {

/// Of a tie at a node of the slave.
template <int D>
struct TieRow {
  BlockRow<D> weights;  ///< W
  double part = 1;      ///< d
};

/// The rows of a tie's jumps become those. Error(Exit::input) that names the obstacle: faces that are not in one plane,
/// or in one along the axis of a body of revolution; fixes of the slave's nodes across it; no node of the slave with
/// d = 1.
/// @param slave its faces
/// @param rows the tie's, by node, which `jumps` has
template <int D>
PretensionedTie<D> pretension(const Nodes<D>& nodes, const Model<D>& model, Index obstacle,
                              const std::vector<Index>& slave, const std::vector<FixedDirections<D>>& fixes,
                              const std::map<Index, TieRow<D>>& rows, JumpBuilder<D>& jumps);

/// Prescribes all of the carrier's unknown, but the length where that is not locked.
/// @param fixed of the carrier, with what fixes prescribe
template <int D>
void hold_carrier(const PretensionedTie<D>& tie, const Pretension& pretension, FixedDirections<D>& fixed);

/// The force on this part of the body; 0 where the length is locked.
template <int D>
double pull(const PretensionedTie<D>& tie, const Model<D>& model);

/// Adds what pulls the sides into each other to a load vector.
template <int D>
void add_pretension(const Model<D>& model, const PairedBodies<D>& pairs, std::vector<double>& load);

}  // namespace signorini
