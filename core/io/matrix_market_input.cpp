#include "core/io/matrix_market_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.hpp"

namespace signorini {
namespace {

constexpr std::string_view blank = " \t\r";
constexpr std::size_t most_shown = 60;  // characters of a line in a message
constexpr const char* banner = "'%%MatrixMarket matrix coordinate|array real|integer general|symmetric'";

std::string lower_case(std::string_view word) {
  std::string out(word);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

/// As from_chars, with a plus sign allowed.
template <class T>
std::errc read(std::string_view word, T& out) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), out);
  return end == word.data() + word.size() ? status : std::errc::invalid_argument;
}

}  // namespace

MatrixMarketInput::MatrixMarketInput(std::string_view text, std::string_view place) : text_(text), place_(place) {
  read_banner();
  read_sizes();
}

void MatrixMarketInput::fail(std::string_view message) const {
  input_error(fmt::format("{}:{}", place_, std::max<Offset>(line_number_, 1)), message);
}

// The next line that is not blank.
bool MatrixMarketInput::next_line() {
  while (position_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    line_ = text_.substr(position_, end - position_);
    position_ = std::min(end + 1, text_.size());
    ++line_number_;
    if (line_.find_first_not_of(blank) != std::string_view::npos) return true;
  }
  return false;
}

void MatrixMarketInput::next_line(Offset entries_so_far) {
  if (!next_line())
    fail(fmt::format("the file ends after {} entries, expected {}; is it truncated?", entries_so_far, entries_));
}

// The number of words, at most one more than there is room for.
std::size_t MatrixMarketInput::split(Words& words) const {
  std::size_t count = 0, begin = line_.find_first_not_of(blank);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line_.find_first_of(blank, begin), line_.size());
    if (count == words.size()) return count + 1;
    words[count++] = line_.substr(begin, end - begin);
    begin = line_.find_first_not_of(blank, end);
  }
  return count;
}

void MatrixMarketInput::read_banner() {
  Words words;
  if (!next_line() || line_number_ > 1 || split(words) != 5 || lower_case(words[0]) != "%%matrixmarket" ||
      lower_case(words[1]) != "matrix")
    fail(fmt::format("found '{}', expected {} in the first line", line_.substr(0, most_shown), banner));
  const auto choice = [&](std::string_view word, std::string_view first, std::string_view second) {
    const std::string found = lower_case(word);
    if (found != first && found != second) fail(fmt::format("found '{}', expected {} or {}", word, first, second));
    return found == first;
  };
  coordinate_ = choice(words[2], "coordinate", "array");
  integer_ = choice(words[3], "integer", "real");
  symmetric_ = choice(words[4], "symmetric", "general");
}

void MatrixMarketInput::read_sizes() {
  const char* expected = coordinate_ ? "rows, columns and the number of entries" : "rows and columns";
  do {
    if (!next_line()) fail(fmt::format("the file ends where {} are expected; is it truncated?", expected));
  } while (line_[line_.find_first_not_of(blank)] == '%');
  Words words;
  if (split(words) != (coordinate_ ? 3u : 2u))
    fail(fmt::format("found '{}', expected {}", line_.substr(0, most_shown), expected));
  constexpr Index most = std::numeric_limits<Index>::max() - 1;
  rows_ = number(words[0], 0, most, "rows");
  columns_ = number(words[1], 0, most, "columns");
  if (symmetric_ && rows_ != columns_)
    fail(fmt::format("found {} rows and {} columns, expected as many of each in a symmetric matrix", rows_, columns_));
  entries_ = symmetric_ ? Offset{rows_} * (Offset{rows_} + 1) / 2 : Offset{rows_} * columns_;
  if (coordinate_ && (read(words[2], entries_) != std::errc{} || entries_ < 0))
    fail(fmt::format("found '{}', expected a number of entries", words[2].substr(0, most_shown)));
  const std::size_t shortest = coordinate_ ? 6 : 2, left = text_.size() - position_;  // "1 1 1\n" and "1\n"
  if (static_cast<std::size_t>(entries_) > (left + 1) / shortest)
    fail(
        fmt::format("found {} entries announced, more than the remaining {} bytes of the file can hold; is it "
                    "truncated?",
                    entries_, left));
}

MatrixMarketInput::Entry MatrixMarketInput::coordinate_entry() const {
  Words words;
  if (split(words) != 3) fail(fmt::format("found '{}', expected row, column and value", line_.substr(0, most_shown)));
  const Index row = number(words[0], 1, rows_, "a row"), column = number(words[1], 1, columns_, "a column");
  if (symmetric_ && column > row)
    fail(fmt::format("found row {}, column {}: expected the lower triangle alone in a symmetric matrix", row, column));
  return {row - 1, column - 1, value(words[2])};
}

double MatrixMarketInput::array_value() const {
  Words words;
  if (split(words) != 1) fail(fmt::format("found '{}', expected one value", line_.substr(0, most_shown)));
  return value(words[0]);
}

double MatrixMarketInput::value(std::string_view word) const {
  double out = 0;
  std::errc status{};
  if (std::int64_t whole = 0; integer_) {
    status = read(word, whole);
    out = static_cast<double>(whole);
  } else {
    status = read(word, out);
  }
  if (status == std::errc::result_out_of_range)
    fail(fmt::format("the value {} is out of range", word.substr(0, most_shown)));
  if (status != std::errc{} || std::isnan(out))
    fail(fmt::format("found '{}', expected {}", word.substr(0, most_shown), integer_ ? "an integer" : "a number"));
  return out;
}

Index MatrixMarketInput::number(std::string_view word, Index least, Index most, const char* meaning) const {
  Index out = 0;
  if (read(word, out) != std::errc{} || out < least || out > most)
    fail(fmt::format("found '{}', expected {} from {} to {}", word.substr(0, most_shown), meaning, least, most));
  return out;
}

void MatrixMarketInput::expect_end() {
  if (next_line())
    fail(fmt::format("found '{}' after all {} entries, expected the end of the file", line_.substr(0, most_shown),
                     entries_));
}

}  // namespace signorini
