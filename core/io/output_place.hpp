#pragma once
#include <filesystem>
#include <span>
#include <string>

namespace signorini {

/// Where a file goes that the user named as an output.
struct OutputPlace {
  std::filesystem::path path;  ///< links followed: what is replaced by a new file, or written through
  bool through = false;        ///< exists and is no regular file: a device, a pipe
};

/// Whether nobody may write there, not even its owner, or this user may not.
bool is_read_only(const std::filesystem::path& path);

/// Follows symbolic links, such that point nowhere as well.
/// @param inputs files that the run reads; empty names stand for none
/// @throws Error(Exit::input) for a folder, for what is read-only, and for one of the inputs
OutputPlace output_place(const std::filesystem::path& file, std::span<const std::filesystem::path> inputs = {});

/// Writes to an open file and does not close it; Error(Exit::input) at `place` with the system's reason.
void write_all(int file, const std::string& text, const std::string& place);

/// Writes to what exists, without replacing it.
void write_through(const std::filesystem::path& path, const std::string& text);

}  // namespace signorini
