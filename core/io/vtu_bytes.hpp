#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace signorini {

/// Bytes that a VTU file holds as they are or in base64. The latter may consist of several padded pieces.
class VtuBytes {
 public:
  VtuBytes(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  /// The next n bytes, or nothing if there are less or they are not base64.
  std::optional<std::string> read(std::size_t n);
  /// No more bytes than this are left.
  std::size_t at_most() const;

 private:
  bool decode_four();

  std::string_view text_;
  bool base64_;
  std::size_t position_ = 0;
  std::string decoded_;  // up to three bytes
};

/// Unpacks zlib data of which the exact size is known; nothing if it is not as announced.
std::optional<std::string> inflate(std::string_view packed, std::size_t size);

}  // namespace signorini
