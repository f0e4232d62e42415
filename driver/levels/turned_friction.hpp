#pragma once
#include "core/fem/recovery/contact.hpp"

namespace signorini {

/// Whether friction of one of the obstacles acts against what it was in the last step, and most of it at nodes that
/// have come into contact since. All that these have moved in a step counts, before they touched as well: where contact
/// moves on by more than its size, as where a blade rolls onto a drum, that may be more than what they slip, and the
/// other way. Shorter steps tell.
template <int B>
bool turned_at_newcomers(const ContactState<B>& last, const ContactState<B>& now);

}  // namespace signorini
