#include "core/solver/options_from_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/error.hpp"
#include "core/input/range.hpp"
#include "core/solver/option_table.hpp"

namespace signorini {
namespace {

/// One text "KEY=VALUE".
class Assignment {
 public:
  explicit Assignment(const std::string& text) : place_("solver." + text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) input_error(place_, "expected KEY=VALUE");
    key_ = trimmed(std::string_view(text).substr(0, equals));
    value_ = trimmed(std::string_view(text).substr(equals + 1));
  }

  void apply(SolverOptions& options) const {
    const auto table = option_table();
    const auto row = std::ranges::find_if(table, [&](const auto& one) { return key_ == one.name; });
    if (row == table.end()) unknown_key();
    const Range range(row->range);
    std::visit([&](auto member) { read(range, options.*member); }, row->member);
  }

 private:
  static std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(' ');
    return first == text.npos ? std::string_view() : text.substr(first, text.find_last_not_of(' ') + 1 - first);
  }

  [[noreturn]] void unknown_key() const {
    std::vector<std::string> names;
    for (const auto& row : option_table()) names.emplace_back(row.name);
    input_error(place_, fmt::format("unknown key '{}'{}; expected one of the solver's for which no meshes are needed",
                                    key_, did_you_mean(key_, names)));
  }

  [[noreturn]] void refuse(const Range& range, std::string_view kind) const {
    input_error(place_, fmt::format("found '{}', expected {}{}", value_, range.expected(kind),
                                    did_you_mean(value_, range.choices())));
  }

  void read(const Range& range, bool& out) const {
    if (value_ != "true" && value_ != "false") refuse(range, "true or false");
    out = value_ == "true";
  }

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void read(const Range& range, Number& out) const {
    const auto [end, error] = std::from_chars(value_.data(), value_.data() + value_.size(), out);
    const bool whole = error == std::errc() && end == value_.data() + value_.size();
    if (!whole || !range.contains(static_cast<double>(out)))
      refuse(range, std::is_integral_v<Number> ? "a whole number" : "a number");
  }

  void read(const Range& range, std::string& out) const {
    std::string_view text = value_;
    const bool quoted = text.size() > 1 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
    if (quoted) text = text.substr(1, text.size() - 2);
    if (!range.contains(text)) refuse(range, "a text");
    out = text;
  }

  std::string place_;
  std::string_view key_, value_;
};

}  // namespace

SolverOptions options_from_text(std::span<const std::string> assignments) {
  SolverOptions options;
  for (const std::string& text : assignments) Assignment(text).apply(options);
  return options;
}

}  // namespace signorini
