#pragma once
#include "core/component/registry.hpp"

namespace signorini {

/// Adds the components of this folder: newton, pgs.
void register_coarse_solvers(Registry& registry);

}  // namespace signorini
