#include "core/io/text_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "core/base/error.hpp"

namespace signorini {
namespace {

constexpr std::string_view trailing("\0\x1a \t\v\f\r\n", 8);

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// Without what from_chars does not take.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

}  // namespace

TextLines::TextLines(std::string_view text, std::string_view place, LineFormat format)
    : text_(text.substr(0, text.find_last_not_of(trailing) + 1)), place_(place), size_(text.size()), format_(format) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

bool TextLines::is_line_end(std::size_t at) const {
  return at < text_.size() && (text_[at] == '\n' || text_[at] == '\r');
}

void TextLines::step_over_line_end() {
  if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
  ++at_;
  ++line_;
}

void TextLines::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (format_.continued && text_[at_] == '\\' && is_line_end(at_ + 1)) {
      ++at_;
      step_over_line_end();
    } else if (format_.comments && text_[at_] == '#') {
      at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
    } else {
      return;
    }
  }
}

std::string_view TextLines::word() {
  skip_blanks();
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && !is_line_end(at_) && !(format_.comments && text_[at_] == '#') &&
         !(format_.continued && text_[at_] == '\\' && is_line_end(at_ + 1)))
    ++at_;
  return text_.substr(start, at_ - start);
}

bool TextLines::next_line() {
  while (started_ && !word().empty()) {
  }
  started_ = true;
  for (skip_blanks(); is_line_end(at_); skip_blanks()) step_over_line_end();
  return at_ < text_.size();
}

std::string_view TextLines::next() {
  if (!started_) next_line();
  const std::string_view found = word();
  return found.empty() && next_line() ? word() : found;
}

std::optional<double> TextLines::to_real(std::string_view word) {
  const std::string_view text = without_plus(word);
  double value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || status == std::errc::invalid_argument) return {};
  if (status == std::errc::result_out_of_range) value = std::strtod(std::string(text).c_str(), nullptr);  // 0 or inf
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<Offset> TextLines::to_integer(std::string_view word) {
  const std::string_view text = without_plus(word);
  Offset value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return end == text.data() + text.size() && status == std::errc{} ? std::optional(value) : std::nullopt;
}

void TextLines::fail_count(std::string_view word, Offset n, std::string_view expected) const {
  if (n < 0) fail_at(word, expected);
  fail(fmt::format("found {} as {}, more than the {} bytes of the file can hold", n, expected, size_));
}

void TextLines::fail(Offset line, std::string_view message) const {
  input_error(place_, fmt::format("line {}: {}", line, message));
}

void TextLines::fail_at(std::string_view word, std::string_view expected) const {
  if (word.empty() && at_ == text_.size())
    fail(fmt::format("the file ends where {} is expected; is it truncated?", expected));
  if (word.empty()) fail(fmt::format("the line ends where {} is expected", expected));
  std::string shown;
  for (const char c : word.substr(0, 40))
    shown += c >= ' ' && c < 127 ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  fail(fmt::format("found '{}', expected {}", shown, expected));
}

}  // namespace signorini
