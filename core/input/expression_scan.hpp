#pragma once
#include <string>

namespace signorini {

struct ScannedExpression {
  std::string text;  ///< as long as the original: one line, chains of prefix operators such as `- -x` or `!-x` reduced
  bool has_variables = false;
  bool has_normal = false;  ///< nx, ny or nz
  bool has_t = false;
  bool has_place = false;  ///< x, y or z, or the normal there
};

/// Checks an expression completely (characters, length, numbers, names, numbers of arguments, brackets, order of values
/// and operators), so that messages are ours and what reaches the parser is well formed.
/// Throws Error(Exit::input) with origin, expression and column.
ScannedExpression scan_expression(const std::string& text, const std::string& origin);

}  // namespace signorini
