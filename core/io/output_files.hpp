#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/io/atomic_files.hpp"
#include "core/io/output_place.hpp"

namespace signorini {

/// The files of a run that its user named one by one, in one folder or several. Regular ones appear together or not at
/// all. "-" is standard output; once it is among them, what is printed goes to standard error.
class OutputFiles {
 public:
  /// @param inputs files that the run reads, which no output may be
  explicit OutputFiles(std::vector<std::filesystem::path> inputs) : inputs_(std::move(inputs)) {}
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  /// Makes sure that it can be written, and creates its folder; false where it is the same file as an earlier one.
  /// Error(Exit::input) as that of output_place() and AtomicFiles.
  bool add(const std::filesystem::path& file);

  /// What a file is to hold that was added.
  void write(const std::filesystem::path& file, std::string text);

  /// Everything that was written gets into its place: first what is written through, so that a device that takes no
  /// more leaves the other files as they were.
  void commit();

 private:
  OutputPlace place_of(const std::filesystem::path& file);
  void redirect_prints();

  std::vector<std::filesystem::path> inputs_;
  std::map<std::filesystem::path, OutputPlace> places_;
  std::map<std::filesystem::path, AtomicFiles> folders_;
  std::map<std::filesystem::path, std::string> through_;  // until commit()
  int standard_output_ = -1;
};

}  // namespace signorini
