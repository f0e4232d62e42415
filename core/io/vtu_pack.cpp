#include "core/io/vtu_pack.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace signorini {
namespace {

constexpr std::size_t block_size = std::size_t{1} << 18, sample_size = block_size / 64;

/// Packs any number of blocks, one after the other.
class Deflater {
 public:
  explicit Deflater(int level) : compressor_(libdeflate_alloc_compressor(level)) {
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

/// Blocks are taken as they come by the threads that pack them.
class Packing {
 public:
  Packing(std::span<const char> bytes, double worthwhile)
      : bytes_(bytes), worthwhile_(worthwhile), blocks_((bytes.size() + block_size - 1) / block_size) {}

  void work() {
    Deflater fast(1), none(0);
    std::string sample;
    for (std::size_t k; (k = next_++) < blocks_.size();) {
      const auto block = bytes_.subspan(k * block_size, std::min(block_size, bytes_.size() - k * block_size));
      const auto start = block.first(std::min(sample_size, block.size()));
      fast.pack(start, sample);
      const bool shrinks = static_cast<double>(sample.size()) < worthwhile_ * static_cast<double>(start.size());
      (shrinks ? fast : none).pack(block, blocks_[k]);
      if (shrinks) blocks_[k].shrink_to_fit();
    }
  }

  /// The header, then the blocks.
  std::vector<std::string> pieces() && {
    std::vector<std::uint64_t> header{blocks_.size(), block_size, bytes_.size() % block_size};
    for (const std::string& block : blocks_) header.push_back(block.size());
    blocks_.insert(blocks_.begin(),
                   std::string(reinterpret_cast<const char*>(header.data()), header.size() * sizeof header[0]));
    return std::move(blocks_);
  }

 private:
  std::span<const char> bytes_;
  double worthwhile_;
  std::vector<std::string> blocks_;
  std::atomic<std::size_t> next_{0};
};

}  // namespace

std::vector<std::string> pack_vtu(std::span<const char> bytes, double worthwhile, Crew& crew) {
  Packing packing(bytes, worthwhile);
  crew.run([&] { packing.work(); });
  return std::move(packing).pieces();
}

}  // namespace signorini
