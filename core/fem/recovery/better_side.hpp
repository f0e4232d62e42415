#pragma once
#include "core/fem/recovery/master_side.hpp"

namespace signorini {

/// Where two bodies touch, the side with the larger faces cannot transmit what changes within these: that side's nodes
/// feel means over them. Fine faces of the other side follow the kinks that the coarse side's displacement has from
/// face to face; what that makes of pressures at nodes averages out over its faces. So the errors of the fine side's
/// forces go along with each other over a face of the coarse side: those of its pressures are larger than
/// RecoveredPressure::error says, by the root of how many of its nodes are on such a face. Where they are then larger
/// than those of the coarse side's pressures, both sides' pressures and tractions are these, as nodes see them in the
/// mean, and so are the largest one, and whether it is resolved. (Coarse faces that are rigid have no such kinks: there
/// forces scatter little, and the fine side's pressures stay.)
/// @param pairs Discretization::pairs
template <int B>
void take_better_side(const Model<B>& model, const PairedBodies<B>& pairs, MasterSide<B>& masters,
                      ContactState<B>& slaves);

}  // namespace signorini
