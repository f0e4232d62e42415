#include "core/io/vtu_pack.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

#include "core/io/vtu_bytes.hpp"

namespace signorini {
namespace {

std::string pack(const std::string& bytes, int threads, double worthwhile = 0.6) {
  Crew crew(threads);
  std::string all;
  for (const std::string& piece : pack_vtu(bytes, worthwhile, crew)) all += piece;
  return all;
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

// Pieces of a large file that shrink give back what they were packed into.
TEST(VtuPack, KeepsNoMoreMemoryThanTheFileTakes) {
  Crew crew(2);
  std::size_t kept = 0, size = 0;
  for (const std::string& piece : pack_vtu(std::string(std::size_t{1} << 22, 'x') + noise(1 << 20), 0.6, crew)) {
    kept += piece.capacity();
    size += piece.size();
  }
  EXPECT_LT(kept, size + size / 100 + 1000);
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
