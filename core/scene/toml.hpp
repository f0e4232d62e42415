#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "core/input/raw.hpp"

namespace signorini {

/// Reads TOML. Syntax errors, invalid UTF-8, excessive nesting, numbers that are not finite and kinds of values that no
/// scene has (dates, tables within tables) are Error(Exit::input) with file, line and column.
RawDocument parse_toml(std::string_view text, const std::string& name);

/// A single TOML value; nothing if `text` is none.
std::optional<RawValue> parse_toml_value(const std::string& text, const std::string& origin);

}  // namespace signorini
