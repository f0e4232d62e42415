#pragma once
#include "core/component/registry.hpp"

namespace signorini {

/// Adds the components of this folder: min_merge.
void register_transfers(Registry& registry);

}  // namespace signorini
