#pragma once
#include <filesystem>
#include <string>

namespace signorini {

/// What is missing of a 64 bit ELF file that is shorter than its headers say, as after a copy that broke off: the
/// loader of the system maps it and dies of SIGBUS. "" where nothing is, and for other files, which it refuses.
std::string missing_of_elf(const std::filesystem::path& file);

}  // namespace signorini
