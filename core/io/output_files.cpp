#include "core/io/output_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/base/error.hpp"

namespace signorini {
namespace fs = std::filesystem;

namespace {
bool is_standard_output(const fs::path& file) { return file == "-" || file == "/dev/stdout"; }
}  // namespace

OutputFiles::~OutputFiles() {
  if (standard_output_ >= 0) close(standard_output_);
}

void OutputFiles::redirect_prints() {
  std::fflush(stdout);
  standard_output_ = dup(STDOUT_FILENO);
  if (standard_output_ < 0) input_error("standard output", "cannot be written: it is closed");
  dup2(STDERR_FILENO, STDOUT_FILENO);
}

/// Regular files by their folder's true name, so that two ways to write one path are one.
OutputPlace OutputFiles::place_of(const fs::path& file) {
  OutputPlace place = output_place(file, inputs_);
  if (place.through) return place;
  const fs::path folder = fs::weakly_canonical(fs::absolute(place.path).parent_path());
  folders_.try_emplace(folder, folder);
  place.path = folder / place.path.filename();
  return place;
}

bool OutputFiles::add(const fs::path& file) {
  if (is_standard_output(file)) {
    if (standard_output_ >= 0) return false;
    redirect_prints();
    return true;
  }
  const OutputPlace place = place_of(file);
  std::error_code none;
  const bool twice = !place.through && std::ranges::any_of(places_, [&](const auto& other) {
    return other.second.path == place.path || fs::equivalent(other.second.path, place.path, none);
  });
  places_.emplace(file, place);
  return !twice;
}

void OutputFiles::write(const fs::path& file, std::string text) {
  const auto place = places_.find(file);
  if (place == places_.end() || place->second.through)
    through_[file] = std::move(text);
  else
    write_text(folders_.at(place->second.path.parent_path()).stage(place->second.path.filename().string()), text);
}

void OutputFiles::commit() {
  for (const auto& [file, text] : through_)
    if (is_standard_output(file))
      write_all(standard_output_, text, "standard output");
    else
      write_through(places_.at(file).path, text);
  for (auto& [path, files] : folders_) files.commit();
}

}  // namespace signorini
