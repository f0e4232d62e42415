#include "core/io/staging_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <string>
#include <vector>

namespace signorini {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = ".signorini-";

bool is_staging_name(std::string_view name) {
  return name.starts_with(prefix) && name.size() > prefix.size() &&
         std::all_of(name.begin() + prefix.size(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

enum class Lock { taken, held_by_another, unknown };

Lock take(int folder) {
  if (folder < 0) return Lock::held_by_another;  // removed meanwhile, or another user's
  if (flock(folder, LOCK_EX | LOCK_NB) == 0) return Lock::taken;
  return errno == EWOULDBLOCK ? Lock::held_by_another : Lock::unknown;
}

int open_folder(const fs::path& path) { return open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC); }

/// Whether the open folder is still the one of that name.
bool exists(int folder, const fs::path& path) {
  struct stat opened {
  }, named{};
  return fstat(folder, &opened) == 0 && lstat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

/// Between its making and its locking another process may take a folder for left over: then the next number is tried.
StagingFolder::StagingFolder(const fs::path& parent) {
  for (long number = getpid();; ++number) {
    path_ = parent / fmt::format("{}{}", prefix, number);
    if (!fs::create_directory(path_)) continue;
    lock_ = open_folder(path_);
    if (lock_ < 0 && errno != ENOENT)
      throw fs::filesystem_error("", path_, std::error_code(errno, std::generic_category()));
    if (take(lock_) != Lock::held_by_another && exists(lock_, path_)) return;
    if (lock_ >= 0) close(lock_);
  }
}

StagingFolder::~StagingFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  close(lock_);
}

void StagingFolder::remove_left_overs(const fs::path& parent) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(parent))
    if (is_staging_name(entry.path().filename().string())) found.push_back(entry.path());
  for (const fs::path& path : found) {
    const int folder = open_folder(path);
    std::error_code ignored;  // another user's
    if (take(folder) == Lock::taken) fs::remove_all(path, ignored);
    if (folder >= 0) close(folder);
  }
}

}  // namespace signorini
