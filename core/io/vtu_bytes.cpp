#include "core/io/vtu_bytes.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace signorini {
namespace {

constexpr int invalid = -1, padding = -2, space = -3;

constexpr auto base64_digits = [] {
  std::array<int, 256> digits{};
  for (int& d : digits) d = invalid;
  for (int i = 0; i < 26; ++i) {
    digits['A' + i] = i;
    digits['a' + i] = 26 + i;
  }
  for (int i = 0; i < 10; ++i) digits['0' + i] = 52 + i;
  digits['+'] = 62;
  digits['/'] = 63;
  digits['='] = padding;
  for (const char c : {' ', '\n', '\r', '\t'}) digits[static_cast<unsigned char>(c)] = space;
  return digits;
}();

}  // namespace

bool VtuBytes::decode_four() {
  std::uint32_t bits = 0;
  int digits = 0, pads = 0;
  while (digits < 4) {
    if (position_ == text_.size()) return false;
    const int d = base64_digits[static_cast<unsigned char>(text_[position_++])];
    if (d == space) continue;
    if (d == invalid || (d >= 0 && pads > 0) || (d == padding && digits < 2)) return false;
    pads += d == padding;
    bits = bits << 6 | static_cast<std::uint32_t>(d == padding ? 0 : d);
    ++digits;
  }
  for (int k = 0; k < 3 - pads; ++k) decoded_ += static_cast<char>(bits >> (16 - 8 * k) & 0xff);
  return true;
}

std::size_t VtuBytes::at_most() const {
  const std::size_t left = text_.size() - position_;
  return base64_ ? decoded_.size() + left / 4 * 3 + 3 : left;
}

std::optional<std::string> VtuBytes::read(std::size_t n) {
  if (n > at_most()) return {};
  if (!base64_) {
    position_ += n;
    return std::string(text_.substr(position_ - n, n));
  }
  std::string bytes;
  bytes.reserve(n);
  while (bytes.size() < n) {
    if (decoded_.empty() && !decode_four()) return {};
    const std::size_t taken = std::min(n - bytes.size(), decoded_.size());
    bytes.append(decoded_, 0, taken);
    decoded_.erase(0, taken);
  }
  return bytes;
}

std::optional<std::string> inflate(std::string_view packed, std::size_t size) {
  constexpr std::size_t greatest_ratio = 1040;  // of the deflate format: 1032
  if (size / greatest_ratio > packed.size()) return {};
  std::string bytes(size, '\0');
  uLongf found = size;
  const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &found,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (status != Z_OK || found != size) return {};
  return bytes;
}

}  // namespace signorini
