#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace signorini {

/// Result files of one run that appear together or not at all. They are written into a hidden folder beside their final
/// place and renamed by commit(). Without commit() nothing stays behind, nor do folders that were made for it.
/// What a process that was killed left in the folder is removed.
class AtomicFiles {
 public:
  /// Creates `folder`; Error(Exit::input) if that is impossible or nothing can be written there.
  explicit AtomicFiles(std::filesystem::path folder);
  ~AtomicFiles();
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;

  /// Where to write the file that is to be called `name`.
  std::filesystem::path stage(const std::string& name) const { return staging_ / name; }

  /// Renames all files written so far and returns their final names, sorted. Other files in the folder are removed
  /// where `outdated` holds for their name: what an earlier run wrote there.
  std::vector<std::filesystem::path> commit(const std::function<bool(const std::string&)>& outdated = {});

 private:
  void create_folder();
  void remove_left_overs() const;
  void remove_traces() noexcept;
  void remove_outdated(const std::vector<std::filesystem::path>& written,
                       const std::function<bool(const std::string&)>& outdated) const;

  std::filesystem::path folder_, staging_;
  std::vector<std::filesystem::path> created_;  ///< folders made for this run, outermost first
  bool committed_ = false;
};

/// Writes a whole file; Error(Exit::input) naming it when that fails (a full disk, for example).
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace signorini
