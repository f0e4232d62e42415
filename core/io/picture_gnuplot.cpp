#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>

#include "core/io/atomic_files.hpp"
#include "core/io/picture.hpp"

extern char** environ;

namespace signorini {
namespace {

std::filesystem::path make_temporary_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "signorini-plot-XXXXXX").string();
  return mkdtemp(name.data()) ? std::filesystem::path(name) : std::filesystem::path();
}

/// gnuplot's own words go to a file, not to the user's terminal.
int spawn_gnuplot(pid_t* child, const std::string& script, const std::string& log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  const char* const argv[] = {"gnuplot", "-d", script.c_str(), nullptr};  // -d: without the user's own start-up file
  const int error = posix_spawnp(child, "gnuplot", &actions, nullptr, const_cast<char* const*>(argv), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// The exit status, or -1 when the time is over and the child was ended.
int wait_for(pid_t child, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  int status = 0;
  for (;;) {
    const pid_t done = waitpid(child, &status, WNOHANG);
    if (done == child) return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    if (done < 0 && errno != EINTR) return 128;
    if (std::chrono::steady_clock::now() > end) break;
    poll(nullptr, 0, 5);
  }
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  return -1;
}
}  // namespace

Gnuplot::Gnuplot() : folder_(make_temporary_folder()) {
  if (folder_.empty()) problem_ = "there is no folder for temporary files";
}

Gnuplot::~Gnuplot() {
  if (child_ > 0) wait_for(child_, 0);
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

void Gnuplot::add_data(const std::string& name, const std::string& text) {
  if (problem_.empty()) write_text(folder_ / name, text);
}

void Gnuplot::start(const std::string& script, const std::filesystem::path& picture, int width, int height) {
  picture_ = picture;
  if (!problem_.empty()) return;
  const std::string heading = fmt::format(
      "cd '{}'\nset terminal pngcairo size {},{} font 'sans,12' background '#ffffff'\nset output 'picture.png'\n",
      folder_.string(), width, height);
  write_text(folder_ / "script.gp", heading + script);
  const int error = spawn_gnuplot(&child_, (folder_ / "script.gp").string(), (folder_ / "log").string());
  if (error != 0) {
    child_ = -1;
    problem_ = error == ENOENT ? "the program gnuplot is not installed" : std::strerror(error);
  }
}

std::string Gnuplot::finish(double timeout_seconds) {
  if (!problem_.empty()) return problem_;
  const int status = wait_for(child_, timeout_seconds);
  child_ = -1;
  if (status < 0) return fmt::format("gnuplot took longer than {} s", timeout_seconds);
  if (status == 127) return "the program gnuplot is not installed";
  if (status > 0) return fmt::format("gnuplot ended with status {}", status);
  std::error_code error;
  std::filesystem::copy_file(folder_ / "picture.png", picture_, error);
  return error ? "gnuplot wrote no picture" : "";
}

}  // namespace signorini
