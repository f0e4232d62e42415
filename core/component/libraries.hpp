#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace signorini {

/// A shared library of this project or of a plugin.
struct Library {
  std::string file;
  std::string licence;  ///< as SPDX names it, that of what it is linked with included; "": it does not say
};

/// Those that have been loaded by now: the core library, then plugins and the project's libraries that are loaded when
/// needed, in the order in which they were.
std::vector<Library> loaded_libraries();

/// The licence of one of them; "" where it is not known.
std::string licence_of(const std::string& file);

void remember_library(const std::filesystem::path& file, std::string licence);

}  // namespace signorini
