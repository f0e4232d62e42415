#include "core/io/cairo/png.hpp"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace signorini {
namespace {

/// The most significant byte first.
std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  return big_endian(static_cast<std::uint32_t>(data.size())) + body +
         big_endian(libdeflate_crc32(0, body.data(), body.size()));
}

/// Each row as its difference from the one above, which is zero over most of a drawing.
std::string filtered(std::span<const std::uint32_t> pixels, int width, int height) {
  constexpr char up = 2;
  std::string bytes;
  bytes.reserve(std::size_t(height) * (1 + 3 * std::size_t(width)));
  for (std::size_t row = 0, at = 0; row < std::size_t(height); ++row) {
    bytes += up;
    for (int column = 0; column < width; ++column, ++at)
      for (int shift = 16; shift >= 0; shift -= 8) {
        const std::uint32_t above = row == 0 ? 0 : pixels[at - width];
        bytes += static_cast<char>((pixels[at] >> shift & 0xff) - (above >> shift & 0xff));
      }
  }
  return bytes;
}

std::string packed(const std::string& bytes) {
  constexpr int level = 3;
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  return out;
}

}  // namespace

std::string png(std::span<const std::uint32_t> pixels, int width, int height) {
  constexpr char bits = 8, colours = 2;
  const std::string header = big_endian(static_cast<std::uint32_t>(width)) +
                             big_endian(static_cast<std::uint32_t>(height)) + std::string{bits, colours, 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", packed(filtered(pixels, width, height))) +
         chunk("IEND", "");
}

}  // namespace signorini
