#include "core/input/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/error.hpp"
#include "core/input/expression.hpp"
#include "core/input/expression_scan.hpp"
#include "core/input/range.hpp"

namespace signorini {
namespace {

[[noreturn]] void wrong_type(const RawValue& raw, std::string_view expected) {
  input_error(raw.origin, fmt::format("expected {}, found {}", expected, describe(raw)));
}

// A finite number, or nothing when the value is no number.
std::optional<double> number_of(const RawValue& raw) {
  if (const auto* number = std::get_if<double>(&raw.value)) return *number;
  if (const auto* integer = std::get_if<std::int64_t>(&raw.value)) return static_cast<double>(*integer);
  return std::nullopt;
}

constexpr double off_range = 1e-12;  // of places and t, and of values around 1

double checked(double number, const RawValue& raw, std::string_view range) {
  if (std::holds_alternative<std::string>(raw.value)) number = Range(range).rounded(number, off_range);  // expressions
  if (!Range(range).contains(number)) wrong_type(raw, Range(range).expected("a number"));
  return number;
}

// How far an expression's value at a site may be off by rounding: as far as rounding of its place and of t takes it. Of
// both directions the one that changes less counts, for across a jump there is no rounding.
double slack(const Field& field, const Site& site) {
  const double here = field(site);
  const double size = std::max({std::abs(site.x[0]), std::abs(site.x[1]), std::abs(site.x[2])});
  const auto change = [&](int k, double by) {
    Site near = site;
    (k < 3 ? near.x[k] : near.t) += by * (k < 3 ? size : 1);
    try {
      return std::abs(field(near) - here);
    } catch (const Error&) {  // it has no value there
      return 0.0;
    }
  };
  double most = off_range;
  for (int k = 0; k < 4; ++k) most = std::max(most, std::min(change(k, -off_range), change(k, off_range)));
  return most;
}

// The same expression, whose values are checked against the range wherever it is evaluated. What is off it by rounding
// alone is its end.
Field restricted(Field field, std::string_view range) {
  const std::string text = field.text(), origin = field.origin();
  const bool uses_t = field.uses_t();
  auto value = [field = std::move(field), range = Range(range)](const Site& site) {
    double v = field(site);
    if (!range.contains(v)) v = range.rounded(v, slack(field, site));
    if (!range.contains(v))
      input_error(field.origin(),
                  fmt::format("expression {} is {} at ({}, {}, {}), expected {}", in_quotes(field.text()), v, site.x[0],
                              site.x[1], site.x[2], range.expected("a number")));
    return v;
  };
  return Field(std::move(value), text, origin, false, uses_t);  // the field itself sees to the normal
}

template <class Convert>
auto each(const RawValue& raw, std::string_view expected, Convert convert) {
  std::vector<decltype(convert(raw))> all;
  for (const RawValue& entry : to_list(raw, expected)) all.push_back(convert(entry));
  return all;
}

}  // namespace

std::string describe(const RawValue& raw) {
  if (const auto* flag = std::get_if<bool>(&raw.value)) return *flag ? "true" : "false";
  if (const auto* integer = std::get_if<std::int64_t>(&raw.value)) return fmt::format("{}", *integer);
  if (const auto* number = std::get_if<double>(&raw.value)) {
    const std::string digits = fmt::format("{}", *number);
    return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;  // as it was written
  }
  if (const auto* text = std::get_if<std::string>(&raw.value)) return "the text " + in_quotes(*text);
  return fmt::format("a list of {}", std::get<RawValue::List>(raw.value).size());
}

bool to_flag(const RawValue& raw) {
  if (const auto* flag = std::get_if<bool>(&raw.value)) return *flag;
  wrong_type(raw, "true or false");
}

std::int64_t to_integer(const RawValue& raw, std::string_view range) {
  const auto* integer = std::get_if<std::int64_t>(&raw.value);
  if (!integer || !Range(range).contains(static_cast<double>(*integer)))
    wrong_type(raw, Range(range).expected("a whole number"));
  return *integer;
}

double to_number(const RawValue& raw, std::string_view range) {
  if (const std::optional<double> number = number_of(raw)) return checked(*number, raw, range);
  const auto* text = std::get_if<std::string>(&raw.value);
  if (!text) wrong_type(raw, Range(range).expected("a number"));
  const Field field = compile_expression(*text, raw.origin);
  const double number = field(Site{});
  if (!field.constant())
    input_error(raw.origin,
                fmt::format("expected a number, found expression {}, which has variables", in_quotes(*text)));
  return checked(number, raw, range);
}

std::string to_text(const RawValue& raw, std::string_view range) {
  const auto* text = std::get_if<std::string>(&raw.value);
  const Range choice(range);
  if (!text) wrong_type(raw, choice.expected("a text"));
  if (!choice.contains(std::string_view(*text)))
    input_error(raw.origin, fmt::format("expected {}, found {}{}", choice.expected("a text"), in_quotes(*text),
                                        did_you_mean(*text, choice.choices())));
  return *text;
}

std::string to_choice(const RawValue& raw, std::string_view range) {
  const auto* integer = std::get_if<std::int64_t>(&raw.value);
  const auto* flag = std::get_if<bool>(&raw.value);
  if (!integer && !flag) return to_text(raw, range);
  std::string text = integer ? std::to_string(*integer) : *flag ? "true" : "false";
  if (!Range(range).contains(text)) wrong_type(raw, Range(range).expected("a text"));
  return text;
}

Field to_field(const RawValue& raw, std::string_view range) {
  if (const std::optional<double> number = number_of(raw)) return checked(*number, raw, range);
  const auto* text = std::get_if<std::string>(&raw.value);
  if (!text) wrong_type(raw, Range(range).expected("a number or an expression"));
  Field field = compile_expression(*text, raw.origin);
  if (const std::optional<double> number = field.constant()) return checked(*number, raw, range);
  return range.empty() ? field : restricted(std::move(field), range);
}

Field to_field_of_t(const RawValue& raw) {
  if (const auto* text = std::get_if<std::string>(&raw.value); text && scan_expression(*text, raw.origin).has_place)
    input_error(raw.origin, fmt::format("expected a number or an expression in t alone, found {}, which depends on "
                                        "the place: a total is one for all places",
                                        in_quotes(*text)));
  return to_field(raw);
}

const RawValue::List& to_list(const RawValue& raw, std::string_view expected) {
  if (const auto* list = std::get_if<RawValue::List>(&raw.value)) return *list;
  wrong_type(raw, expected);
}

std::vector<Field> to_fields(const RawValue& raw, std::string_view range) {
  return each(raw, "a list of numbers or expressions", [&](const RawValue& entry) { return to_field(entry, range); });
}

std::vector<double> to_numbers(const RawValue& raw, std::string_view range) {
  return each(raw, "a list of numbers", [&](const RawValue& entry) { return to_number(entry, range); });
}

std::vector<std::int64_t> to_integers(const RawValue& raw, std::string_view range) {
  return each(raw, "a list of whole numbers", [&](const RawValue& entry) { return to_integer(entry, range); });
}

std::vector<std::string> to_texts(const RawValue& raw) {
  if (std::holds_alternative<std::string>(raw.value)) return {to_text(raw)};
  return each(raw, "a list of texts", [](const RawValue& entry) { return to_text(entry); });
}

}  // namespace signorini
