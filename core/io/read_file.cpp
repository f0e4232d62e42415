#include "core/io/read_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

#include "core/base/error.hpp"

namespace signorini {
namespace {

/// zlib's state, released in any case.
struct Inflater {
  z_stream stream{};
  bool ready;

  Inflater() : ready(inflateInit2(&stream, 16 + MAX_WBITS) == Z_OK) {}  // 16: the gzip format
  ~Inflater() {
    if (ready) inflateEnd(&stream);
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

}  // namespace

std::string read_file(const std::filesystem::path& path, std::string_view kind) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure)) input_error(path.string(), fmt::format("no such {}", kind));
  if (!std::filesystem::is_regular_file(path, failure)) input_error(path.string(), "is not a file");
  const auto size = std::filesystem::file_size(path, failure);
  std::ifstream file(path, std::ios::binary);
  if (failure || !file) input_error(path.string(), fmt::format("cannot open the {}", kind));
  std::string content(size, '\0');
  file.read(content.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(file.gcount()) != size)
    input_error(path.string(), fmt::format("cannot read the {}", kind));
  return content;
}

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::optional<std::string> gunzip(std::string_view bytes) {
  Inflater inflater;
  z_stream& stream = inflater.stream;
  std::string content;
  std::array<char, 1 << 16> buffer;
  bool in_member = true;
  while (inflater.ready) {
    if (stream.avail_in == 0) {
      const std::size_t taken = std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max());
      if (taken == 0) break;
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
      stream.avail_in = static_cast<uInt>(taken);
      bytes.remove_prefix(taken);
    }
    if (!in_member && inflateReset(&stream) != Z_OK) return {};
    in_member = true;
    do {
      stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
      stream.avail_out = buffer.size();
      const int status = ::inflate(&stream, Z_NO_FLUSH);
      if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR) return {};
      content.append(buffer.data(), buffer.size() - stream.avail_out);
      in_member = status != Z_STREAM_END;
    } while (in_member && stream.avail_out == 0);
  }
  if (!inflater.ready || in_member) return {};
  return content;
}

}  // namespace signorini
