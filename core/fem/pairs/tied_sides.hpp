#pragma once
#include <vector>

#include "core/fem/conditions/fixes.hpp"
#include "core/fem/pairs/paired_sides.hpp"

namespace signorini {

/// Where the sides of a tie are farthest from each other at the start.
template <int D>
struct WidestGap {
  double width = 0;     ///< user's unit of length
  Point<D> place{};     ///< on the slave
  double touching = 0;  ///< what is no more than this is none, but what meshes of one surface leave
};

template <int D>
WidestGap<D> widest_gap(const Nodes<D>& nodes, const MortarCoupling<D>& coupling, const std::vector<Index>& slave);

/// The sides of a tie. Left out are nodes where a fix prescribes something, but where it prescribes that all around of
/// the master, too; where an obstacle acts on one body alone; and those that are taken: but for faces all of whose
/// nodes are such. So a linear displacement leaves a constant stress.
/// Error(Exit::input) that names the obstacle: bodies that are apart at the start, or overlap, by more than it admits.
/// @param taken vertices, ascending
template <int D>
MortarCoupling<D> couple_tied(const Nodes<D>& nodes, const Model<D>& model, const ObstacleTerm<D>& term,
                              const PairedFaces& faces, const std::vector<FixedDirections<D>>& fixes,
                              const std::vector<Index>& taken);

}  // namespace signorini
