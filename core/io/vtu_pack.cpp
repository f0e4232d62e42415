#include "core/io/vtu_pack.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>

namespace signorini {
namespace {

constexpr std::size_t block_size = std::size_t{1} << 18, sample_size = block_size / 64;

/// Packs any number of blocks, one after the other.
class Deflater {
 public:
  Deflater() : compressor_(libdeflate_alloc_compressor(1)) {
    if (!compressor_) throw std::bad_alloc();
  }

  void pack(std::span<const char> bytes, std::string& out) {
    out.resize(libdeflate_zlib_compress_bound(compressor_.get(), bytes.size()));  // there is room for all
    out.resize(libdeflate_zlib_compress(compressor_.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  }

 private:
  struct Free {
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor_;
};

/// A zlib stream of bytes as they are (RFC 1950 and 1951): a header, pieces behind their lengths, a checksum.
namespace stored {

constexpr std::size_t longest = 65535, before = 2, before_piece = 5, behind = 4;

std::size_t size(std::size_t bytes) { return before + (bytes + longest - 1) / longest * before_piece + bytes + behind; }

void write(std::span<const char> bytes, std::uint32_t checksum, std::ostream& out) {
  const auto put = [&out](std::uint32_t byte) { out.put(static_cast<char>(byte & 255u)); };
  put(0x78), put(0x01);
  for (std::size_t from = 0; from < bytes.size(); from += longest) {
    const auto length = static_cast<std::uint32_t>(std::min(longest, bytes.size() - from));
    put(from + length == bytes.size());
    for (const std::uint32_t number : {length, ~length}) put(number), put(number >> 8);
    out.write(bytes.data() + from, length);
  }
  for (int shift = 24; shift >= 0; shift -= 8) put(checksum >> shift);
}

}  // namespace stored

}  // namespace

/// Blocks are taken as they come by the threads that pack them.
PackedVtu::PackedVtu(std::span<const char> bytes, double worthwhile, Crew& crew)
    : bytes_(bytes), blocks_((bytes.size() + block_size - 1) / block_size) {
  std::atomic<std::size_t> next{0};
  crew.run([&] {
    Deflater deflater;
    std::string sample;
    std::size_t last = blocks_.size();
    for (std::size_t k; (k = next++) < blocks_.size(); last = k) {
      if (is_repeated(k, last)) {
        blocks_[k] = blocks_[last];
        continue;
      }
      const auto whole = block(k), start = whole.first(std::min(sample_size, whole.size()));
      deflater.pack(start, sample);
      if (static_cast<double>(sample.size()) < worthwhile * static_cast<double>(start.size())) {
        deflater.pack(whole, blocks_[k].packed);
        blocks_[k].packed.shrink_to_fit();
      } else {
        blocks_[k].checksum = libdeflate_adler32(1, whole.data(), whole.size());
      }
    }
  });
}

std::span<const char> PackedVtu::block(std::size_t k) const {
  return bytes_.subspan(k * block_size, std::min(block_size, bytes_.size() - k * block_size));
}

/// As where a field is constant.
bool PackedVtu::is_repeated(std::size_t k, std::size_t last) const {
  return last < blocks_.size() && std::ranges::equal(block(k), block(last));
}

std::size_t PackedVtu::size(std::size_t k) const {
  return blocks_[k].packed.empty() ? stored::size(block(k).size()) : blocks_[k].packed.size();
}

std::vector<std::uint64_t> PackedVtu::header() const {
  std::vector<std::uint64_t> header{blocks_.size(), block_size, bytes_.size() % block_size};
  for (std::size_t k = 0; k < blocks_.size(); ++k) header.push_back(size(k));
  return header;
}

std::size_t PackedVtu::size() const {
  std::size_t sum = (3 + blocks_.size()) * sizeof(std::uint64_t);
  for (std::size_t k = 0; k < blocks_.size(); ++k) sum += size(k);
  return sum;
}

std::size_t PackedVtu::kept() const {
  std::size_t sum = blocks_.capacity() * sizeof(Block);
  for (const Block& block : blocks_) sum += block.packed.empty() ? 0 : block.packed.capacity();
  return sum;
}

void PackedVtu::write(std::ostream& out) const {
  const std::vector<std::uint64_t> numbers = header();
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof numbers[0]));
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const std::string& packed = blocks_[k].packed;
    if (packed.empty())
      stored::write(block(k), blocks_[k].checksum, out);
    else
      out.write(packed.data(), static_cast<std::streamsize>(packed.size()));
  }
}

}  // namespace signorini
