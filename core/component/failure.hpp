#pragma once
#include <string_view>

#include "core/sdk/status.hpp"

namespace signorini {

/// Throws what a plugin reported, "ORIGIN: MESSAGE" (a MESSAGE that names a place in the same file stands alone), as
/// bad input, as a problem without solution or as the plugin's own failure; any other code counts as bad input.
[[noreturn]] void throw_failure(const Status& status, std::string_view origin);

}  // namespace signorini
