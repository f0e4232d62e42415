#pragma once
#include "core/fem/recovery/contact.hpp"

namespace signorini {

/// The node of another state at the same vertex and obstacle; null: there is none.
template <int B>
const ContactNode<B>* same_node(const ContactState<B>& contact, const ContactNode<B>& node);

/// Why the direction of friction of one of the obstacles is in doubt; null: of none. Most of it acts at nodes that have
/// come into contact since the last step, and either it acts against what it was in that; or there was none, no step
/// follows that would tell, and contact is no longer where it began: at the node with the least distance then. All that
/// newcomers have moved in a step counts, before they touched as well: where contact moves on by more than its size, as
/// where a blade rolls onto a drum, that may be more than what they slip, and the other way. Shorter steps tell.
/// @param last without nodes: nothing has moved before
/// @param followed by another step
/// @param rounding of distances
template <int B>
const char* doubt_of_friction(const ContactState<B>& last, const ContactState<B>& now, bool followed, double rounding);

}  // namespace signorini
