#pragma once
#include <filesystem>

namespace signorini {

/// The folder of the core library, beside which lie the project's libraries under other licences.
std::filesystem::path core_folder();

/// A function of such a library, which is loaded for good.
/// @param what it is, for the message: "the geometry library"
/// @throws Error(Exit::plugin) naming the path where there is none, or another library
void* load_function(const std::filesystem::path& library, const char* function, const char* what);

}  // namespace signorini
