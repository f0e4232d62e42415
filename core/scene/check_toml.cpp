#include "core/scene/check_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "core/base/error.hpp"

namespace signorini {
namespace {

constexpr std::size_t deepest_brackets = 50;
constexpr int deepest_key = 50;

/// Walks over text outside of strings and comments. On text that is not TOML it agrees with a parser up to the first
/// error, which is where the parser stops.
class Walk {
 public:
  Walk(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  void run() {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;  // byte order mark
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'')
        string(c);
      else if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else
        plain(c);
    }
    if (!open_.empty()) fail_open("the end of the file");
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { input_error(fmt::format("{}:{}", name_, line_), message); }

  /// Where the bracket is that is open.
  [[noreturn]] void fail_open(const std::string& before) const {
    input_error(fmt::format("{}:{}", name_, open_line_.back()),
                fmt::format("the '{}' in this line is not closed: expected '{}' before {}",
                            open_.back() == ']' ? '[' : '{', open_.back(), before));
  }

  void plain(char c) {
    if (static_cast<unsigned char>(c) >= 127 || (c < ' ' && c != '\t' && c != '\n' && c != '\r'))
      fail("a character that is not plain ASCII outside of texts and comments");
    if (c == '[' && open_.empty() && !in_value_) header();
    if (in_value_ && (c == '[' || c == '{')) expect_token_start(c);
    if (c == '=') begin_value();
    if (c == '\n' && !open_.empty() && !in_value_) fail(fmt::format("expected '{}' in this line", open_.back()));
    ++at_;
    if (c == '\n') ++line_;
    const bool line_end = c == '\n' || c == '\r';
    bracket(c);
    if (c == '}') in_value_ = true;
    if ((line_end && open_.empty()) || c == '{' || (c == ',' && open_.ends_with('}')))
      in_value_ = false;  // a key follows
    if (c == '.' && ++dots_ > deepest_key) fail(fmt::format("a key of more than {} parts", deepest_key));
    if (line_end || c == '=' || c == ',' || c == '{' || c == '[') dots_ = 0;
  }

  void begin_value() {
    if (in_value_ && !open_.empty()) fail_open(fmt::format("the next '=', which is in line {}", line_));
    if (in_value_) input_error(fmt::format("{}:{}", name_, value_line_), "a second '=' before the value's end");
    in_value_ = true;
    value_line_ = line_;
  }

  void bracket(char c) {
    if (c == '[' || c == '{') {
      open_.push_back(c == '[' ? ']' : '}');
      open_line_.push_back(line_);
      if (open_.size() > deepest_brackets) fail(fmt::format("more than {} nested brackets", deepest_brackets));
    }
    if (c != ']' && c != '}') return;
    if (open_.empty()) fail(fmt::format("a '{}' that closes nothing", c));
    if (open_.back() != c) fail(fmt::format("expected '{}', found '{}'", open_.back(), c));
    open_.pop_back();
    open_line_.pop_back();
  }

  // The TOML library takes any first character of a table's name for a quote.
  void header() const {
    std::size_t at = at_ + (text_.substr(at_, 2) == "[[" ? 2 : 1);
    while (at < text_.size() && (text_[at] == ' ' || text_[at] == '\t')) ++at;
    const char c = at < text_.size() ? text_[at] : ']';
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view("_-\"']").find(c) == std::string_view::npos)
      fail("expected the name of a table after '['");
  }

  // The TOML library reads on through quotes and brackets inside of a value, and does not survive every character
  // there.
  void expect_token_start(char c) const {
    const std::string_view before = in_value_ ? " \t\r\n=,[{" : " \t\r\n=,[{.";
    if (at_ > 0 && before.find(text_[at_ - 1]) == std::string_view::npos && !(at_ == 3 && text_[0] == '\xef'))
      fail(fmt::format("a {} in the middle of a value", c));
  }

  // The TOML library goes on over the white space after a backslash at the end of a line, and is undefined on most
  // characters that are not ASCII where it looks for its end.
  void expect_ascii_after_line_end() const {
    const std::size_t next = text_.find_first_not_of(" \t\n\v\f\r", at_ + 1);
    if (next != std::string_view::npos && static_cast<unsigned char>(text_[next]) >= 127)
      fail("a character that is not plain ASCII after a '\\'; expected an escape, or the line's end and plain text");
  }

  void string(char quote) {
    expect_token_start(quote);
    const std::string triple(3, quote);
    const bool multiline = text_.substr(at_, 3) == triple;
    const std::string_view close = multiline ? std::string_view(triple) : text_.substr(at_, 1);
    at_ += close.size();
    while (at_ < text_.size() && text_.substr(at_, close.size()) != close) {
      if (text_[at_] == '\n') {
        if (!multiline) return;  // no TOML
        ++line_;
      }
      const bool escape = quote == '"' && text_[at_] == '\\';
      if (escape && multiline) {
        expect_ascii_after_line_end();
        if (text_.substr(at_ + 1, 1) == "\n") ++line_;
      }
      at_ += escape ? 2 : 1;
    }
    at_ = std::min(at_ + close.size(), text_.size());
    // A multi-line string may end in up to five quotes.
    for (int extra = 0; multiline && extra < 2 && at_ < text_.size() && text_[at_] == quote; ++extra) ++at_;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0, line_ = 1, value_line_ = 1;
  std::string open_;  // the brackets that will close what is open
  std::vector<std::size_t> open_line_;
  int dots_ = 0;
  bool in_value_ = false;
};

}  // namespace

void check_toml(std::string_view text, const std::string& name) { Walk(text, name).run(); }

}  // namespace signorini
