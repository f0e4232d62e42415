#include "core/io/atomic_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <utility>

#include "core/base/error.hpp"
#include "core/io/output_place.hpp"

namespace signorini {
namespace fs = std::filesystem;

namespace {

/// All that there are.
struct Living {
  std::mutex mutex;
  std::vector<AtomicFiles*> files;
};
Living& living() {
  static auto* all = new Living;  // outlives whoever is in it
  return *all;
}

}  // namespace

AtomicFiles::AtomicFiles(fs::path folder, std::function<bool(const std::string&)> ours,
                         std::span<const fs::path> inputs)
    : folder_(std::move(folder)), ours_(std::move(ours)) {
  try {
    create_folder();
    StagingFolder::remove_left_overs(folder_);
    const StagingFolder possible(folder_);  // removed at once: a long run that is killed leaves none
    refuse_irreplaceable(inputs);
  } catch (const fs::filesystem_error& error) {
    remove_traces();
    fail(error);
  }
  const std::lock_guard lock(living().mutex);
  living().files.push_back(this);
}

AtomicFiles::~AtomicFiles() {
  {
    const std::lock_guard lock(living().mutex);
    std::erase(living().files, this);
  }
  remove_traces();
}

void AtomicFiles::abandon_all() noexcept {
  const std::lock_guard lock(living().mutex);
  for (AtomicFiles* files : living().files) files->remove_traces();
}

void AtomicFiles::fail(const fs::filesystem_error& error) const {
  input_error(folder_.string(), fmt::format("cannot write results here: {}", error.code().message()));
}

void AtomicFiles::create_folder() {
  std::vector<fs::path> missing;
  for (fs::path path = folder_; !path.empty() && !fs::exists(path); path = path.parent_path()) missing.push_back(path);
  for (auto path = missing.rbegin(); path != missing.rend(); ++path)
    if (fs::create_directory(*path)) created_.push_back(*path);
  if (!fs::is_directory(folder_)) throw fs::filesystem_error("", std::make_error_code(std::errc::not_a_directory));
  if (is_read_only(folder_)) throw fs::filesystem_error("", std::make_error_code(std::errc::permission_denied));
}

/// What there is under names of this run's, sorted.
std::vector<fs::path> AtomicFiles::earlier() const {
  std::vector<fs::path> found;
  if (!ours_) return found;
  for (const auto& entry : fs::directory_iterator(folder_))
    if (ours_(entry.path().filename().string())) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

void AtomicFiles::refuse_irreplaceable(std::span<const fs::path> inputs) const {
  for (const fs::path& path : earlier()) {
    if (!fs::is_regular_file(fs::symlink_status(path)))
      input_error(path.string(), "is a folder, a link, a pipe or a device, expected a regular file or none");
    output_place(path, inputs);
  }
}

fs::path AtomicFiles::stage(const std::string& name) try {
  if (!staging_) staging_.emplace(folder_);
  return staging_->path() / name;
} catch (const fs::filesystem_error& error) {
  fail(error);
}

void AtomicFiles::remove_traces() noexcept {
  staging_.reset();
  if (committed_) return;
  std::error_code ignored;
  for (auto path = created_.rbegin(); path != created_.rend(); ++path) fs::remove(*path, ignored);  // only if empty
}

/// The new file is as open to others as the one it replaces.
void AtomicFiles::put_in_place(const fs::path& name) const {
  const fs::path staged = staging_->path() / name, place = folder_ / name;
  if (fs::exists(place)) fs::permissions(staged, fs::status(place).permissions());
  fs::rename(staged, place);
}

std::vector<fs::path> AtomicFiles::commit() try {
  std::vector<fs::path> written;
  if (staging_)
    for (const auto& entry : fs::directory_iterator(staging_->path())) written.push_back(entry.path().filename());
  std::sort(written.begin(), written.end());
  const std::vector<fs::path> before = earlier();
  committed_ = true;
  for (fs::path& name : written) {
    put_in_place(name);
    name = folder_ / name;
  }
  for (const fs::path& path : before)
    if (!std::binary_search(written.begin(), written.end(), path)) fs::remove(path);
  return written;
} catch (const fs::filesystem_error& error) {
  fail(error);
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  errno = 0;
  out << text;
  out.close();
  if (out) return;
  const int reason = errno;
  std::error_code none;
  fs::remove(file, none);
  input_error(file.string(), reason == 0
                                 ? "cannot be written: is the disk full?"
                                 : fmt::format("cannot be written: {}; is the disk full?", std::strerror(reason)));
}

}  // namespace signorini
