#include "core/io/atomic_files.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <utility>

#include "core/base/error.hpp"

namespace signorini {
namespace fs = std::filesystem;

namespace {

const std::string staging_prefix = ".signorini-";

/// Whether a folder of this name is left from a process that has ended, or from one that had this one's number.
bool is_left_over(const std::string& name) {
  if (!name.starts_with(staging_prefix)) return false;
  pid_t process = 0;
  const auto [end, error] = std::from_chars(name.data() + staging_prefix.size(), name.data() + name.size(), process);
  if (error != std::errc() || end != name.data() + name.size() || process <= 0) return false;
  return process == getpid() || (kill(process, 0) != 0 && errno == ESRCH);
}

}  // namespace

AtomicFiles::AtomicFiles(fs::path folder)
    : folder_(std::move(folder)), staging_(folder_ / fmt::format("{}{}", staging_prefix, getpid())) {
  try {
    create_folder();
    remove_left_overs();
    fs::create_directory(staging_);
  } catch (const fs::filesystem_error& error) {
    remove_traces();
    input_error(folder_.string(), fmt::format("cannot write results here: {}", error.code().message()));
  }
}

AtomicFiles::~AtomicFiles() { remove_traces(); }

void AtomicFiles::create_folder() {
  std::vector<fs::path> missing;
  for (fs::path path = folder_; !path.empty() && !fs::exists(path); path = path.parent_path()) missing.push_back(path);
  for (auto path = missing.rbegin(); path != missing.rend(); ++path)
    if (fs::create_directory(*path)) created_.push_back(*path);
  if (!fs::is_directory(folder_)) throw fs::filesystem_error("", std::make_error_code(std::errc::not_a_directory));
}

void AtomicFiles::remove_left_overs() const {
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder_))
    if (entry.is_directory() && !entry.is_symlink() && is_left_over(entry.path().filename().string()))
      old.push_back(entry.path());
  std::error_code ignored;  // another user's
  for (const fs::path& folder : old) fs::remove_all(folder, ignored);
}

void AtomicFiles::remove_traces() noexcept {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  if (committed_) return;
  for (auto path = created_.rbegin(); path != created_.rend(); ++path) fs::remove(*path, ignored);  // only if empty
}

void AtomicFiles::remove_outdated(const std::vector<fs::path>& written,
                                  const std::function<bool(const std::string&)>& outdated) const {
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder_))
    if (entry.is_regular_file() && outdated(entry.path().filename().string()) &&
        !std::binary_search(written.begin(), written.end(), entry.path()))
      old.push_back(entry.path());
  for (const fs::path& file : old) fs::remove(file);
}

std::vector<fs::path> AtomicFiles::commit(const std::function<bool(const std::string&)>& outdated) {
  std::vector<fs::path> written;
  try {
    for (const auto& entry : fs::directory_iterator(staging_)) written.push_back(entry.path().filename());
    std::sort(written.begin(), written.end());
    committed_ = true;
    for (auto& name : written) {
      fs::rename(staging_ / name, folder_ / name);
      name = folder_ / name;
    }
    if (outdated) remove_outdated(written, outdated);
  } catch (const fs::filesystem_error& error) {
    input_error(folder_.string(), fmt::format("cannot write results here: {}", error.code().message()));
  }
  return written;
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) input_error(file.string(), "cannot be written: is the disk full?");
}

}  // namespace signorini
