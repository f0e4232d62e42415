#pragma once
#include <optional>
#include <string_view>

#include "core/base/types.hpp"

namespace signorini {

/// What a format of text lets stand in its lines.
struct LineFormat {
  bool comments = false;   ///< from # to the end of the line
  bool continued = false;  ///< a backslash at the end of a line goes on with the next one
};

/// A cursor over the words of a text, line by line. Lines end as on any system; a byte order mark in the beginning and
/// zero bytes at the end, which pad a file, are left out. Every failure is an Error(Exit::input) with the line.
class TextLines {
 public:
  TextLines(std::string_view text, std::string_view place, LineFormat format);

  /// Goes to the next line with words, the first one at first; false at the end.
  bool next_line();
  /// The next word of this line, empty at its end.
  std::string_view word();
  /// The next word of this line or of one below, empty at the end of the text.
  std::string_view next();

  /// A word as a number, which is finite. `expected` tells, when it is called, what is expected in its place.
  template <class Expected>
  double real(std::string_view word, const Expected& expected) const {
    const std::optional<double> value = to_real(word);
    if (!value) fail_at(word, expected());
    return *value;
  }
  template <class Expected>
  Offset integer(std::string_view word, const Expected& expected) const {
    const std::optional<Offset> value = to_integer(word);
    if (!value) fail_at(word, expected());
    return *value;
  }
  /// The same as a count of things that take a byte each at least; more than the text can hold is an error.
  template <class Expected>
  std::size_t count(std::string_view word, const Expected& expected) const {
    const Offset n = integer(word, expected);
    if (n < 0 || static_cast<std::size_t>(n) > size_) fail_count(word, n, expected());
    return static_cast<std::size_t>(n);
  }

  Offset line() const { return line_; }
  /// Where the word taken last ends in the text that was given.
  std::size_t position() const { return at_; }
  [[noreturn]] void fail(std::string_view message) const { fail(line_, message); }
  [[noreturn]] void fail(Offset line, std::string_view message) const;
  /// Complains about a word that is not what is expected, or about none.
  [[noreturn]] void fail_at(std::string_view word, std::string_view expected) const;

 private:
  static std::optional<double> to_real(std::string_view word);
  static std::optional<Offset> to_integer(std::string_view word);
  [[noreturn]] void fail_count(std::string_view word, Offset n, std::string_view expected) const;
  bool is_line_end(std::size_t at) const;
  void step_over_line_end();
  void skip_blanks();

  std::string_view text_, place_;
  std::size_t size_;  ///< with its padding
  LineFormat format_;
  std::size_t at_ = 0;
  Offset line_ = 1;
  bool started_ = false;
};

}  // namespace signorini
