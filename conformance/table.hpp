#pragma once
#include "conformance/check.hpp"

namespace signorini::conformance {

/// Of all_checks() the one of this id, which there is.
const Check& check_named(std::string_view id);

}  // namespace signorini::conformance
