#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/input/field.hpp"
#include "core/input/raw.hpp"

/// From raw values to typed ones. Each throws Error(Exit::input) naming the value's origin, what was found and what was
/// expected: another type, or a value outside `range` ("" for any; the grammar is that of OptionSpec::range). Used for
/// the scene's own keys as for the options of components.
namespace signorini {

bool to_flag(const RawValue& raw);
std::int64_t to_integer(const RawValue& raw, std::string_view range = "");
/// A number, or an expression without variables.
double to_number(const RawValue& raw, std::string_view range = "");
std::string to_text(const RawValue& raw, std::string_view range = "");
/// A text or a whole number, as a text.
std::string to_choice(const RawValue& raw, std::string_view range);
/// A number or an expression. The range of an expression is checked at every evaluation.
Field to_field(const RawValue& raw, std::string_view range = "");
/// A number or an expression in t alone.
Field to_field_of_t(const RawValue& raw);
/// A list of numbers or expressions.
std::vector<Field> to_fields(const RawValue& raw, std::string_view range = "");
/// A list of numbers or of expressions without variables.
std::vector<double> to_numbers(const RawValue& raw, std::string_view range = "");
std::vector<std::int64_t> to_integers(const RawValue& raw, std::string_view range = "");
/// A list of texts, or one text.
std::vector<std::string> to_texts(const RawValue& raw);

/// The entries of a list; any other value is an error saying that `expected` was expected.
const RawValue::List& to_list(const RawValue& raw, std::string_view expected);

/// What a value is, for messages: "the number 3", "the text 'top'", "a list of 2".
std::string describe(const RawValue& raw);

}  // namespace signorini
