#include "core/io/cairo/png.hpp"

#include <libdeflate.h>

#include <memory>
#include <new>
#include <vector>

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
  const std::vector<std::uint32_t> black(static_cast<std::size_t>(width), 0);
  const std::size_t row_size = 1 + 3 * std::size_t(width);
  std::string bytes(std::size_t(height) * row_size, up);
  const std::uint32_t* above = black.data();
  for (std::size_t row = 0; row < std::size_t(height); ++row) {
    const std::uint32_t* here = pixels.data() + row * std::size_t(width);
    char* out = bytes.data() + row * row_size + 1;
    for (int column = 0; column < width; ++column)
      for (int shift = 16; shift >= 0; shift -= 8)
        *out++ = static_cast<char>((here[column] >> shift & 0xff) - (above[column] >> shift & 0xff));
    above = here;
  }
  return bytes;
}

std::string packed(const std::string& bytes) {
  constexpr int level = 3;  // faster than the lowest ones, with so many equal bytes
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
