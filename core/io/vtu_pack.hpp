#pragma once
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "core/base/crew.hpp"

namespace signorini {

/// An array as VTK's vtkZLibDataCompressor stores it, with numbers of 64 bits in its header: how many blocks, their
/// size, that of the last one where it is smaller, the packed sizes, and then the blocks, each a zlib stream. It does
/// not depend on the number of threads.
class PackedVtu {
 public:
  /// Keeps a reference to the bytes: blocks that do not shrink are written from there.
  /// @param worthwhile blocks of which a sample shrinks to more than this part of its size (the digits of a smooth
  ///   solution, say) are stored as they are, which takes a twentieth of the time
  PackedVtu(std::span<const char> bytes, double worthwhile, Crew& crew);

  std::size_t size() const;
  void write(std::ostream& out) const;

  /// Bytes of its own.
  std::size_t kept() const;

 private:
  struct Block {
    std::string packed;          // empty: stored as it is
    std::uint32_t checksum = 0;  // of what is stored
  };

  std::span<const char> block(std::size_t k) const;
  bool is_repeated(std::size_t k, std::size_t last) const;
  std::size_t size(std::size_t k) const;
  std::vector<std::uint64_t> header() const;

  std::span<const char> bytes_;
  std::vector<Block> blocks_;
};

}  // namespace signorini
