#pragma once
#include <filesystem>

namespace signorini {

/// A hidden folder inside another one, for files that are not complete. The process that made it holds a lock on it,
/// which the system releases however the process ends: where the lock can be had, the folder is left over. A process
/// number would say nothing where several machines or containers share the folder.
class StagingFolder {
 public:
  /// @throws std::filesystem::filesystem_error where none can be made
  explicit StagingFolder(const std::filesystem::path& parent);
  ~StagingFolder();  ///< removes it with what it holds
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Removes the folders in `parent` that nobody holds. Where the file system knows no locks, none are.
  static void remove_left_overs(const std::filesystem::path& parent);

 private:
  std::filesystem::path path_;
  int lock_;
};

}  // namespace signorini
