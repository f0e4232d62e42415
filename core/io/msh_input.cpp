#include "core/io/msh_input.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>

#include "core/base/error.hpp"

namespace signorini {
namespace {

bool ends_word(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

}  // namespace

void MshInput::skip_space() {
  while (position_ < content_.size() && ends_word(content_[position_])) ++position_;
}

bool MshInput::at_end() {
  skip_space();
  return position_ == content_.size();
}

bool MshInput::next_is(char c) { return !at_end() && content_[position_] == c; }

std::string_view MshInput::word() {
  skip_space();
  const std::size_t start = position_;
  while (position_ < content_.size() && !ends_word(content_[position_])) ++position_;
  return content_.substr(start, position_ - start);
}

std::string_view MshInput::rest_of_line() {
  const std::size_t start = position_;
  const std::size_t end = std::min(content_.find('\n', start), content_.size());
  position_ = std::min(end + 1, content_.size());
  return content_.substr(start, end - start);
}

void MshInput::expect(std::string_view marker) {
  skip_space();
  const std::size_t start = position_;
  if (const std::string_view found = word(); found != marker) {
    position_ = start;
    if (start + found.size() == content_.size() && marker.starts_with(found)) ends(std::string(marker).c_str());
    fail(fmt::format("expected {}, found '{}'", marker, found.substr(0, 40)));
  }
}

void MshInput::skip_past(std::string_view marker) {
  const auto lower = [](unsigned char c) { return std::tolower(c); };
  for (std::size_t line = position_; line < content_.size();) {
    const std::size_t start = std::min(content_.find_first_not_of(" \t", line), content_.size());
    if (std::ranges::equal(content_.substr(start, marker.size()), marker, {}, lower, lower)) {
      position_ = start + marker.size();
      return;
    }
    line = std::min(content_.find_first_of("\r\n", start), content_.size() - 1) + 1;
  }
  fail(fmt::format("the file ends without {}", marker));
}

template <class T>
T MshInput::parse(const char* kind, const char* meaning) {
  skip_space();
  const std::size_t start = position_;
  std::string_view text = word();
  if (text.empty()) ends(meaning);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size()) {
    position_ = start;
    fail(fmt::format("expected {}, {}; found '{}'", meaning, kind, text.substr(0, 40)));
  }
  return value;
}

Offset MshInput::text_integer(const char* meaning) { return parse<Offset>("an integer", meaning); }
double MshInput::text_real(const char* meaning) { return parse<double>("a number", meaning); }

double MshInput::coordinate() {
  const double x = number<double>("a coordinate");
  if (!std::isfinite(x)) fail(fmt::format("found a coordinate {}, expected a finite number", x));
  return x;
}

Offset MshInput::count(Offset n, Offset least_text, Offset least_binary, const char* meaning) const {
  if (n < 0) fail(fmt::format("found {} {}, expected 0 or more", n, meaning));
  const Offset left = static_cast<Offset>(content_.size() - position_);
  if (n > left / (binary ? least_binary : least_text) + 1)
    fail(fmt::format("found {} {}, more than the remaining {} bytes of the file can hold", n, meaning, left));
  return n;
}

void MshInput::fail(std::string_view message) const {
  if (binary) input_error(place_, fmt::format("byte {}: {}", position_, message));
  const auto line = 1 + std::count(content_.begin(), content_.begin() + static_cast<Offset>(position_), '\n');
  input_error(fmt::format("{}:{}", place_, line), message);
}

void MshInput::ends(const char* meaning) const {
  fail(fmt::format("the file ends where {} is expected; is it truncated?", meaning));
}

void MshInput::out_of_range(Offset value, const char* meaning) const {
  fail(fmt::format("{} is out of range: {}", meaning, value));
}

}  // namespace signorini
