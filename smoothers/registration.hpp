#pragma once
#include "core/component/registry.hpp"

namespace signorini {

/// Adds the smoothers: forward, backward, symmetric, adjoint.
void register_smoothers(Registry& registry);

}  // namespace signorini
