#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace signorini::conformance {

/// The id in libsignorini_obstacle_ID.so; "" for another name.
std::string id_in_name(const std::filesystem::path& file);

/// The symbols that a library offers to others.
std::vector<std::string> exported_symbols(const std::filesystem::path& file);

}  // namespace signorini::conformance
