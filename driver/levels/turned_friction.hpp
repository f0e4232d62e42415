#pragma once
#include "core/fem/elements/nodes.hpp"
#include "core/fem/recovery/contact.hpp"

namespace signorini {

/// Why the direction of friction of one of the obstacles is in doubt; null: of none. Most of it acts at nodes that have
/// come into contact since the last step, and either it acts against what it was in that; or there was none, no step
/// follows that would tell, and contact is no longer where it began: at the node with the least distance then. All that
/// newcomers have moved in a step counts, before they touched as well: where contact moves on by more than its size, as
/// where a blade rolls onto a drum, that may be more than what they slip, and the other way. Shorter steps tell.
/// @param last without nodes: nothing has moved before
/// @param followed by another step
template <int B>
const char* doubt_of_friction(const ContactState<B>& last, const ContactState<B>& now, bool followed);

/// Likewise where nothing touched an obstacle in the last step: what bodies move along its surface before they touch
/// counts as slip. Without a doubt where that is less than a fifth of a planned step, or of no matter: where they
/// hardly move along the surface, or so much that all slips in any case.
/// @param masters nodes of the other bodies in contact
/// @param by how nodes have moved since the last step, global, D per node
/// @param part of a planned step that this one is
template <int D>
const char* doubt_of_approach(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& last,
                              const ContactState<D>& now, const std::vector<ContactNode<D>>& masters,
                              const std::vector<double>& by, double part);

}  // namespace signorini
