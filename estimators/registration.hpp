#pragma once
#include "core/component/registry.hpp"

namespace signorini {

/// The estimators of this project. Their library is loaded when one is created.
void register_estimators(Registry& registry);

}  // namespace signorini
