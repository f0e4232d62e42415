#pragma once
#include <optional>
#include <string_view>

namespace signorini {

/// What the line "KEY: N kB" of a file of /proc says, in bytes; nothing where there is no such line.
std::optional<double> proc_bytes(const char* file, std::string_view key);

}  // namespace signorini
