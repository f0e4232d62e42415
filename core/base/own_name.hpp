#pragma once
#include <string_view>

namespace signorini {

/// What the program calls that for which others say `name`: "young" for "E"; "" where it knows none.
std::string_view own_name(std::string_view name);

}  // namespace signorini
