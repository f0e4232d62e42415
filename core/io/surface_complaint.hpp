#pragma once
#include <filesystem>
#include <string>

namespace signorini {

/// What is wrong with an OFF or STL file that could not be read as a surface, with its line, such as "line 7: ...";
/// empty where nothing is found.
std::string surface_complaint(const std::filesystem::path& file);

}  // namespace signorini
