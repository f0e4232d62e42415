#pragma once
#include "core/fem/recovery/master_side.hpp"

namespace signorini {

/// Where two bodies touch, the side with the larger faces cannot transmit what changes within these: that side's nodes
/// feel means over them. Fine faces of the other side follow the kinks that the coarse side's displacement has from
/// face to face; what that makes of pressures at nodes averages out over its faces. So the errors of the fine side's
/// forces go along with each other over a face of the coarse side: with n of its nodes on such a face their variance is
/// n times that which RecoveredPressure::error says. Where what that adds to the error, sqrt(n - 1) times as much, is
/// more than the error of the coarse side's pressures, both sides' pressures and tractions are these, as nodes see them
/// in the mean, and so is the largest one; the area has what is between nodes of
/// the fine side that press, up to the area of that side. Where
/// the coarse side has too few nodes for that nothing is resolved. (Coarse faces that are rigid have no such kinks:
/// there forces scatter little, and the fine side's pressures stay.)
/// @param pairs Discretization::pairs
template <int B>
void take_better_side(const Model<B>& model, const PairedBodies<B>& pairs, MasterSide<B>& masters,
                      ContactState<B>& slaves);

}  // namespace signorini
