#pragma once
#include "core/component/registry.hpp"

namespace signorini {

/// Adds the transfers: min_merge, mandel, kornhuber, none.
void register_transfers(Registry& registry);

}  // namespace signorini
