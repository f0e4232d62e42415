#pragma once
#include "core/fem/elements/nodes.hpp"
#include "core/fem/recovery/contact.hpp"

namespace signorini {

/// In which part of a step a body was apart from what it touches at its end, where it nears that steadily: what it
/// moves along the surface in that time counts as slip. 0 where that is of no matter to friction: where something
/// touched before; where that slip is little beside what friction may hold back, or all slips in any case; and where
/// the time in contact is a small part of what is left of a planned step.
/// @param last contact at the start of the step; without nodes: nothing has moved before
/// @param masters nodes of the other bodies in contact
/// @param before displacements at the start of the step, global, D per node
/// @param u those at its end
/// @param rest of the planned step after this one, over this one
template <int D>
double part_in_flight(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& last,
                      const ContactState<D>& now, const std::vector<ContactNode<D>>& masters,
                      const std::vector<double>& before, const std::vector<double>& u, double rest);

}  // namespace signorini
