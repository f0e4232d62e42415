#pragma once
#include <string>
#include <string_view>

namespace signorini {

/// A text as it has to stand in a cell of a table of Markdown.
inline std::string in_cell(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

}  // namespace signorini
