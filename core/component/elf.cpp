#include "core/component/elf.hpp"

#include <elf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

namespace signorini {
namespace {

template <class Header>
std::vector<Header> headers(std::ifstream& in, std::uint64_t offset, unsigned count, unsigned size) {
  std::vector<Header> out;
  if (size != sizeof(Header)) return out;
  out.resize(count);
  in.seekg(static_cast<std::streamoff>(offset));
  in.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(count * sizeof(Header)));
  if (!in) out.clear();
  return out;
}

}  // namespace

std::string missing_of_elf(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::uint64_t length = std::filesystem::file_size(file, ignored);
  std::ifstream in(file, std::ios::binary);
  Elf64_Ehdr head{};
  in.read(reinterpret_cast<char*>(&head), sizeof head);
  if (!in || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_ident[EI_CLASS] != ELFCLASS64) return {};
  std::uint64_t expected = std::max(head.e_phoff + std::uint64_t{head.e_phnum} * head.e_phentsize,
                                    head.e_shoff + std::uint64_t{head.e_shnum} * head.e_shentsize);
  for (const auto& segment : headers<Elf64_Phdr>(in, head.e_phoff, head.e_phnum, head.e_phentsize))
    expected = std::max(expected, segment.p_offset + segment.p_filesz);
  if (expected <= length) return {};
  return fmt::format("the file is truncated: it has {} bytes, its headers say {} at least; build or copy it again",
                     length, expected);
}

}  // namespace signorini
