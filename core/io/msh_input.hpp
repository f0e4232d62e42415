#pragma once
#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/base/types.hpp"

namespace signorini {

/// A cursor over an MSH file in memory. Numbers are read as text, or as bytes of either order once a binary format has
/// been announced. Every failure is an Error(Exit::input) with the line, or the byte in binary files.
class MshInput {
 public:
  MshInput(std::string_view content, std::string_view place) : content_(content), place_(place) {}

  bool binary = false;
  bool swapped = false;  ///< the other byte order

  bool at_end();            ///< after white space
  std::string_view word();  ///< up to white space
  bool next_is(char c);     ///< after white space
  std::string_view rest_of_line();
  void expect(std::string_view marker);
  /// Skips everything up to `marker` in the beginning of a line, whatever the case of its letters, and that itself.
  void skip_past(std::string_view marker);

  /// The next number in the format of the file; `meaning` is for messages.
  template <class T>
  T number(const char* meaning) {
    if (binary) return raw<T>(meaning);
    if constexpr (std::is_floating_point_v<T>)
      return text_real(meaning);
    else
      return narrow<T>(text_integer(meaning), meaning);
  }
  /// Numbers that are text in binary files, too.
  Offset text_integer(const char* meaning);
  double text_real(const char* meaning);
  /// A count of things that take at least so many bytes each: more than the file can hold is an error, so that no
  /// count makes us allocate more than a small multiple of the file's size.
  Offset count(Offset n, Offset least_text, Offset least_binary, const char* meaning) const;
  double coordinate();  ///< finite

  template <class T>
  T raw(const char* meaning) {
    if (content_.size() - position_ < sizeof(T)) ends(meaning);
    char bytes[sizeof(T)];
    std::memcpy(bytes, content_.data() + position_, sizeof(T));
    if (swapped) std::reverse(bytes, bytes + sizeof(T));
    position_ += sizeof(T);
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  [[noreturn]] void fail(std::string_view message) const;
  std::string_view place() const { return place_; }

 private:
  template <class T>
  T narrow(Offset value, const char* meaning) const {
    if (value < Offset{std::numeric_limits<T>::min()} ||
        (sizeof(T) < 8 && value > Offset{std::numeric_limits<T>::max()}))
      out_of_range(value, meaning);
    return static_cast<T>(value);
  }
  void skip_space();
  template <class T>
  T parse(const char* kind, const char* meaning);
  [[noreturn]] void ends(const char* meaning) const;
  [[noreturn]] void out_of_range(Offset value, const char* meaning) const;

  std::string_view content_;
  std::string_view place_;
  std::size_t position_ = 0;
};

}  // namespace signorini
