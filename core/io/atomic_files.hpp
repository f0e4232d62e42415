#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/io/staging_folder.hpp"

namespace signorini {

/// Result files of one run that appear together or not at all. They are written into a hidden folder beside their final
/// place and renamed by commit(). Without commit() nothing stays behind, nor do folders that were made for it.
/// What a process that was killed left in the folder is removed.
class AtomicFiles {
 public:
  /// Creates `folder`. Other files there are this run's to replace where `ours` holds for their name: commit() removes
  /// those that it does not write.
  /// @param inputs files that the run reads
  /// @throws Error(Exit::input) where nothing can be written there, or one of `ours` is no file that may be replaced:
  ///   a folder, a link, a device, read-only, an input
  explicit AtomicFiles(std::filesystem::path folder, std::function<bool(const std::string&)> ours = {},
                       std::span<const std::filesystem::path> inputs = {});
  ~AtomicFiles();
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;

  /// Where to write the file that is to be called `name`.
  std::filesystem::path stage(const std::string& name);

  /// Renames all files written so far and returns their final names, sorted.
  std::vector<std::filesystem::path> commit();

  /// Removes what is not committed of all runs of this process, which is about to end while their thread hangs.
  static void abandon_all() noexcept;

 private:
  void create_folder();
  std::vector<std::filesystem::path> earlier() const;
  void refuse_irreplaceable(std::span<const std::filesystem::path> inputs) const;
  void put_in_place(const std::filesystem::path& name) const;
  void remove_traces() noexcept;
  [[noreturn]] void fail(const std::filesystem::filesystem_error& error) const;

  std::filesystem::path folder_;
  std::function<bool(const std::string&)> ours_;
  std::optional<StagingFolder> staging_;        ///< made with the first file
  std::vector<std::filesystem::path> created_;  ///< folders made for this run, outermost first
  bool committed_ = false;
};

/// Writes a whole file; where that fails (on a full disk, for example) there is none, and Error(Exit::input) names it.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace signorini
