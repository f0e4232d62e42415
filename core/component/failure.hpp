#pragma once
#include <string_view>

#include "core/sdk/status.hpp"

namespace signorini {

/// Whether a status tells of a failure of the plugin's own, which names no status of bad input either.
bool is_fault_of_plugin(const Status& status);

/// Throws what a plugin reported, "ORIGIN: MESSAGE" (a MESSAGE that names a place in the same file stands alone), as
/// bad input, as a problem without solution or as the plugin's own failure; any other code counts as bad input.
[[noreturn]] void throw_failure(const Status& status, std::string_view origin);

}  // namespace signorini
