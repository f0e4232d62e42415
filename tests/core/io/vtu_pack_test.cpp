#include "core/io/vtu_pack.hpp"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <sstream>

#include "core/io/vtu_bytes.hpp"

namespace {
std::atomic<std::size_t> bytes_packed{0};
}  // namespace

// What the packer calls, counted.
extern "C" std::size_t libdeflate_zlib_compress(libdeflate_compressor* compressor, const void* in, std::size_t size,
                                                void* out, std::size_t available) {
  using Function = std::size_t (*)(libdeflate_compressor*, const void*, std::size_t, void*, std::size_t);
  static const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "libdeflate_zlib_compress"));
  bytes_packed += size;
  return next(compressor, in, size, out, available);
}

namespace signorini {
namespace {

std::string pack(const std::string& bytes, int threads, double worthwhile = 0.6) {
  Crew crew(threads);
  const PackedVtu packed(bytes, worthwhile, crew);
  std::ostringstream all;
  packed.write(all);
  EXPECT_EQ(packed.size(), all.str().size());
  return all.str();
}

/// As the format prescribes.
std::string unpacked(const std::string& packed) {
  const auto number = [&](std::size_t k) {
    std::uint64_t value;
    std::memcpy(&value, packed.data() + 8 * k, 8);
    return value;
  };
  const std::uint64_t blocks = number(0), size = number(1), last = number(2) == 0 ? size : number(2);
  std::string all;
  std::size_t at = 8 * (3 + blocks);
  for (std::uint64_t k = 0; k < blocks; ++k) {
    const auto block = inflate(std::string_view(packed).substr(at, number(3 + k)), k + 1 == blocks ? last : size);
    if (!block) return "damaged";
    all += *block;
    at += number(3 + k);
  }
  return at == packed.size() ? all : "more than its blocks";
}

std::string noise(std::size_t bytes) {
  std::mt19937_64 random(1);
  std::string text(bytes, ' ');
  for (char& c : text) c = static_cast<char>(random());
  return text;
}

TEST(VtuPack, EveryLengthComesBack) {
  constexpr std::size_t block = std::size_t{1} << 18;
  const std::string all = noise(block) + std::string(2 * block, 'x') + noise(1000);
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, block - 1, block, block + 1, 3 * block, all.size()})
    EXPECT_EQ(unpacked(pack(all.substr(0, length), 1)), all.substr(0, length)) << length;
}

TEST(VtuPack, DoesNotDependOnTheNumberOfThreads) {
  std::string bytes(3000000, ' ');
  for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<char>(std::lround(100 * std::sin(1e-3 * k)));
  bytes += noise(1000000);
  EXPECT_EQ(pack(bytes, 1), pack(bytes, 3));
}

// Output may be a fifth of a run, most of it work per byte: each is packed once, a small sample twice, and what repeats
// itself block after block, as fields do where nothing is, not again.
TEST(VtuPack, PacksEachByteOnceAndRepeatedBlocksNotAgain) {
  constexpr std::size_t block = std::size_t{1} << 18, sample = block / 64;
  const auto work = [](const std::string& bytes) {
    const std::size_t before = bytes_packed;
    pack(bytes, 1);
    return bytes_packed - before;
  };
  EXPECT_LE(work(noise(10 * block)), 10 * (block + sample));
  EXPECT_LE(work(std::string(10 * block, 'x')), block + sample);
  EXPECT_EQ(pack(std::string(10 * block, 'x'), 1), pack(std::string(10 * block, 'x'), 4));
}

// Blocks that shrink give back what they were packed into; others are where they were.
TEST(VtuPack, KeepsNoMoreMemoryThanWhatShrinksTakes) {
  Crew crew(2);
  const std::string shrinks(std::size_t{1} << 22, 'x'), both = shrinks + noise(1 << 20);
  const PackedVtu packed(both, 0.6, crew);
  EXPECT_LT(packed.kept(), pack(shrinks, 1).size() + 5000);
  EXPECT_GT(packed.size(), std::size_t{1} << 20);
}

TEST(VtuPack, ShrinksWhatItCanAndLeavesNoiseAsItIs) {
  EXPECT_LT(pack(std::string(1 << 20, 'x'), 1).size(), 10000u);
  const std::string digits = noise(1 << 20);
  EXPECT_LT(pack(digits, 1).size(), digits.size() + digits.size() / 1000);
  std::string half = digits;
  for (std::size_t k = 0; k < half.size(); ++k)
    if (k / 64 % 2) half[k] = 0;
  EXPECT_LT(pack(half, 1, 0.6).size(), half.size() * 6 / 10);
  EXPECT_GT(pack(half, 1, 0.4).size(), half.size());
}

}  // namespace
}  // namespace signorini
