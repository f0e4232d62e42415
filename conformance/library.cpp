#include "conformance/library.hpp"

#include <elf.h>

#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>

namespace signorini::conformance {
namespace {

template <class T>
T read_at(const std::string& file, std::uint64_t offset) {
  T out{};
  if (offset <= file.size() && sizeof out <= file.size() - offset) std::memcpy(&out, file.data() + offset, sizeof out);
  return out;
}

}  // namespace

std::string id_in_name(const std::filesystem::path& file) {
  constexpr std::string_view prefix = "libsignorini_obstacle_", suffix = ".so";
  const std::string name = file.filename().string();
  if (!name.starts_with(prefix) || !name.ends_with(suffix) || name.size() <= prefix.size() + suffix.size()) return {};
  return name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
}

std::vector<std::string> exported_symbols(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string file = text.str();
  const auto head = read_at<Elf64_Ehdr>(file, 0);
  std::vector<std::string> out;
  for (unsigned k = 0; k < head.e_shnum; ++k) {
    const auto section = read_at<Elf64_Shdr>(file, head.e_shoff + std::uint64_t{k} * sizeof(Elf64_Shdr));
    if (section.sh_type != SHT_DYNSYM) continue;
    const auto names = read_at<Elf64_Shdr>(file, head.e_shoff + std::uint64_t{section.sh_link} * sizeof(Elf64_Shdr));
    for (std::uint64_t at = 0; at + sizeof(Elf64_Sym) <= section.sh_size; at += sizeof(Elf64_Sym)) {
      const auto symbol = read_at<Elf64_Sym>(file, section.sh_offset + at);
      const bool offered = ELF64_ST_BIND(symbol.st_info) != STB_LOCAL && symbol.st_shndx != SHN_UNDEF &&
                           symbol.st_shndx != SHN_ABS && ELF64_ST_VISIBILITY(symbol.st_other) != STV_HIDDEN;
      const std::uint64_t name = names.sh_offset + symbol.st_name;
      if (offered && name < file.size()) out.emplace_back(file.c_str() + name);
    }
  }
  return out;
}

}  // namespace signorini::conformance
