#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace signorini {

/// The range of an option, in the grammar of OptionSpec::range: an interval "(0, inf)", "[0, 1]", or a choice of texts
/// or whole numbers "body | obstacle", or "" for any.
class Range {
 public:
  /// std::invalid_argument for what is neither; the message goes on after the text.
  explicit Range(std::string_view text);

  bool contains(double number) const;
  /// A closed end of the interval that is off the number, outside, by no more than `slack`; without one the number.
  double rounded(double number, double slack) const;
  bool contains(std::string_view text) const;
  /// "a number in (0, inf)", "one of body | obstacle"; `kind` is "a number".
  std::string expected(std::string_view kind) const;
  const std::vector<std::string>& choices() const { return choices_; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  double low_, high_;
  bool closed_low_ = true, closed_high_ = true;
  std::vector<std::string> choices_;
  bool any_other_ = false;
};

}  // namespace signorini
