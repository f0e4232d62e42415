#pragma once
#include "core/component/registry.hpp"

namespace signorini {

/// Adds the smoothers: forward, backward, symmetric, adjoint, surface_first, patch.
void register_smoothers(Registry& registry);

}  // namespace signorini
