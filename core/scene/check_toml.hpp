#pragma once
#include <string>
#include <string_view>

namespace signorini {

/// Throws Error(Exit::input) where TOML text would lead the TOML library astray: brackets or dotted keys nested more
/// deeply than in any scene (the library recurses over both, and does not limit keys); a table's name that begins with
/// a character which the library takes for a quote; characters outside of texts and comments, or first after a
/// line-ending backslash, that are not ASCII, on which its behaviour is undefined.
void check_toml(std::string_view text, const std::string& name);

}  // namespace signorini
