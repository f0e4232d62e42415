#include "conformance/values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "core/input/range.hpp"

namespace signorini::conformance {
namespace {

constexpr double many = 1e12;  // where a range has no end
constexpr long many_whole = 1000;

struct Interval {
  double low = -infinity, high = infinity;
  bool closed_low = false, closed_high = false;
};

/// Of a range that the loader has read already.
Interval interval_of(std::string_view text) {
  Interval out;
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return out;
  out.low = std::strtod(std::string(text.substr(1)).c_str(), nullptr);
  out.high = std::strtod(std::string(text.substr(comma + 1)).c_str(), nullptr);
  out.closed_low = text.front() == '[' && std::isfinite(out.low);
  out.closed_high = text.back() == ']' && std::isfinite(out.high);
  return out;
}

bool is_number(const OptionSpec& option) {
  return option.type != OptionType::text && option.type != OptionType::boolean;
}

std::string assigned(const OptionSpec& option, double value, int dimension) {
  if (option.type == OptionType::integer) return fmt::format("{}={}", option.name, std::llround(value));
  if (option.type != OptionType::vector) return fmt::format("{}={}", option.name, value);
  std::string list;
  for (int i = 0; i < dimension; ++i) list += fmt::format("{}{}", i ? ", " : "", value);
  return fmt::format("{}=[{}]", option.name, list);
}

double inside(const Interval& range, int number) {
  const double step = 0.3 + 0.05 * number;
  if (std::isfinite(range.low) && std::isfinite(range.high))
    return range.low + (range.high - range.low) * (0.5 + 0.01 * (number % 10));
  if (std::isfinite(range.low)) return range.low + step;
  if (std::isfinite(range.high)) return range.high - step;
  return 0.1 * number;
}

/// At an end, or next to one that is open.
double end_of(double end, bool closed, double inwards) {
  if (closed) return end;
  return std::isfinite(end) ? end + inwards * 1e-12 * std::fmax(1, std::fabs(end)) : -inwards * many;
}

}  // namespace

std::string value_within(const OptionSpec& option, int dimension, int number) {
  if (option.type == OptionType::boolean) return fmt::format("{}=true", option.name);
  const Range range(option.range);
  if (!range.choices().empty()) return fmt::format("{}={}", option.name, range.choices().back());
  if (option.type == OptionType::text) return {};
  if (option.type == OptionType::integer && range.contains(2.0)) return fmt::format("{}=2", option.name);
  if (option.type != OptionType::vector) return assigned(option, inside(interval_of(option.range), number), dimension);
  std::string list;  // a unit vector, for most are directions
  for (int i = 0; i < dimension; ++i) list += fmt::format("{}{}", i ? ", " : "", i + 1 == dimension ? 1 : 0);
  return fmt::format("{}=[{}]", option.name, list);
}

Values values_at_ends(const OptionSpec& option, int dimension) {
  if (option.type == OptionType::boolean)
    return {fmt::format("{}=false", option.name), fmt::format("{}=true", option.name)};
  const Range range(option.range);
  Values out;
  for (const std::string& choice : range.choices()) out.push_back(fmt::format("{}={}", option.name, choice));
  if (!out.empty() || !is_number(option)) return out;
  Interval interval = interval_of(option.range);
  if (option.type == OptionType::integer) {
    if (!std::isfinite(interval.low)) interval.low = -many_whole, interval.closed_low = true;
    if (!std::isfinite(interval.high)) interval.high = many_whole, interval.closed_high = true;
    if (!interval.closed_low) interval.low += 1, interval.closed_low = true;
    if (!interval.closed_high) interval.high -= 1, interval.closed_high = true;
  }
  return {assigned(option, end_of(interval.low, interval.closed_low, 1), dimension),
          assigned(option, end_of(interval.high, interval.closed_high, -1), dimension)};
}

}  // namespace signorini::conformance
