#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace signorini {

/// The bytes of a regular file; Error(Exit::input) calling it by `kind` ("mesh file") where there is none.
std::string read_file(const std::filesystem::path& path, std::string_view kind);

/// Whether the bytes are those of a gzip file.
bool is_gzip(std::string_view bytes);

/// What a gzip file holds, all of its members; nothing if it is damaged or cut off.
std::optional<std::string> gunzip(std::string_view bytes);

}  // namespace signorini
