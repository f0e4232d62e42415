#include "core/io/output_place.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/error.hpp"

namespace signorini {
namespace fs = std::filesystem;

namespace {

[[noreturn]] void cannot_be_written(const std::string& place, int reason) {
  input_error(place, fmt::format("cannot be written: {}", std::strerror(reason)));
}

/// The end of a chain of links, which need not exist.
fs::path followed(fs::path file) {
  constexpr int longest_chain = 40;  // as the kernel's
  std::error_code none;
  for (int k = 0; fs::is_symlink(fs::symlink_status(file, none)); ++k) {
    if (k == longest_chain) cannot_be_written(file.string(), ELOOP);
    file = file.parent_path() / fs::read_symlink(file);
  }
  return file;
}

}  // namespace

bool is_read_only(const fs::path& path) {
  std::error_code none;
  constexpr fs::perms write = fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
  return access(path.c_str(), W_OK) != 0 || (fs::status(path, none).permissions() & write) == fs::perms::none;
}

OutputPlace output_place(const fs::path& file, std::span<const fs::path> inputs) {
  std::error_code none;
  const fs::file_status found = fs::status(file, none);
  if (fs::is_directory(found)) input_error(file.string(), "is a folder, expected the name of a file");
  if (!fs::exists(found)) return {followed(file), false};
  if (is_read_only(file)) input_error(file.string(), "is read-only, expected a file that may be written");
  if (!fs::is_regular_file(found)) return {file, true};
  if (std::ranges::any_of(inputs, [&](const fs::path& input) { return fs::equivalent(file, input, none); }))
    input_error(file.string(), "is read by this run, expected another file for its results");
  return {followed(file), false};
}

void write_all(int file, const std::string& text, const std::string& place) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = write(file, text.data() + done, text.size() - done);
    if (n > 0)
      done += static_cast<std::size_t>(n);
    else if (errno != EINTR)
      cannot_be_written(place, errno);
  }
}

void write_through(const fs::path& path, const std::string& text) {
  const int file = open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  if (file < 0) cannot_be_written(path.string(), errno);
  try {
    write_all(file, text, path.string());
  } catch (...) {
    close(file);
    throw;
  }
  if (close(file) != 0) cannot_be_written(path.string(), errno);
}

}  // namespace signorini
