#include "core/input/range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/types.hpp"

namespace signorini {
namespace {

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(' ') - begin + 1));
}

double end_of_interval(std::string_view text) {
  const std::string number = trimmed(text);
  std::size_t read = 0;
  double value = 0;
  try {
    value = std::stod(number, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  if (number.empty() || read != number.size() || std::isnan(value))
    throw std::invalid_argument(fmt::format("has an end '{}' that is no number", number));
  return value;
}

}  // namespace

Range::Range(std::string_view text) : text_(text), low_(-infinity), high_(infinity) {
  if (text.empty()) return;
  const std::size_t comma = text.find(',');
  if (text.front() == '(' || text.front() == '[') {
    if (comma == std::string_view::npos || (text.back() != ')' && text.back() != ']'))
      throw std::invalid_argument("is no interval such as (0, inf) or [0, 1]");
    low_ = end_of_interval(text.substr(1, comma - 1));
    high_ = end_of_interval(text.substr(comma + 1, text.size() - comma - 2));
    if (!(low_ <= high_)) throw std::invalid_argument("contains no number");
    closed_low_ = text.front() == '[';
    closed_high_ = text.back() == ']';
    return;
  }
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('|', begin), text.size());
    choices_.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  any_other_ = choices_.back() == "...";
  if (any_other_) choices_.pop_back();
}

bool Range::contains(double number) const {
  if (!choices_.empty()) return contains(std::string_view(fmt::format("{}", number)));
  return (closed_low_ ? number >= low_ : number > low_) && (closed_high_ ? number <= high_ : number < high_);
}

double Range::rounded(double number, double slack) const {
  const double inside = std::clamp(number, low_, high_);
  return std::abs(number - inside) <= slack && contains(inside) ? inside : number;
}

bool Range::contains(std::string_view text) const {
  return choices_.empty() || any_other_ || std::find(choices_.begin(), choices_.end(), text) != choices_.end();
}

std::string Range::expected(std::string_view kind) const {
  if (choices_.size() == 1) return choices_.front();
  if (!choices_.empty()) return "one of " + text_;
  return text_.empty() ? std::string(kind) : fmt::format("{} in {}", kind, text_);
}

}  // namespace signorini
