#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/input/field.hpp"

namespace signorini {

/// Compiles an expression in x, y, z (position), nx, ny, nz (outer normal), t (step parameter) and pi. Functions are
/// named and meant as in C; `^` is power (right associative, above unary minus); operators bind as in C; c ? a : b
/// evaluates only the branch it takes. NaN in min and max stays NaN, so that it is noticed.
/// An expression without variables becomes a constant. Copies of the field share the compiled expression and may be
/// used from several threads.
/// @param origin where the expression was written: "scene.toml:12: fix.0.value[1]"
/// Throws Error(Exit::input) naming origin, expression, column and the nearest valid name.
Field compile_expression(const std::string& text, const std::string& origin);

/// For messages: the text in quotes, shortened to one readable line.
std::string in_quotes(std::string_view text);

/// A function of expressions; `most` is -1 where any number of arguments is allowed.
struct ExpressionFunction {
  const char* name;
  int fewest, most;
};
std::vector<ExpressionFunction> expression_functions();

}  // namespace signorini
