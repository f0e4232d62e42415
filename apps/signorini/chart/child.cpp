#include "apps/signorini/chart/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>

#include "apps/signorini/interrupt.hpp"
#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"

extern char** environ;

namespace signorini::chart {
namespace {

class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  void write_to(int descriptor, const char* file) {
    posix_spawn_file_actions_addopen(&actions_, descriptor, file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

pid_t start(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<std::string> words{"signorini"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  FileActions actions;
  actions.write_to(STDOUT_FILENO, "/dev/null");
  actions.write_to(STDERR_FILENO, log.c_str());
  pid_t child = 0;
  const int failed = posix_spawn(&child, "/proc/self/exe", actions.get(), nullptr, argv.data(), environ);
  if (failed != 0) throw Error(Exit::input, fmt::format("no process can be started: {}", std::strerror(failed)));
  return child;
}

/// What a run said last, without the name of the program.
std::string message(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::string line, last;
  while (std::getline(in, line))
    if (const auto at = line.find("error: "); at != std::string::npos) last = line.substr(at + 7);
  return last;
}

}  // namespace

Ended run_self(const std::vector<std::string>& arguments, double seconds, const std::filesystem::path& log) {
  const Stopwatch watch;
  const pid_t child = start(arguments, log);
  int status = 0;
  bool late = false;
  while (waitpid(child, &status, WNOHANG) == 0) {
    late = late || watch.elapsed() > seconds;
    if (late || interrupted()) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  stop_if_interrupted();
  if (late) return {false, fmt::format("not ready after {:g} s", seconds)};
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {true, {}};
  const std::string said = message(log);
  if (!said.empty()) return {false, said};
  return {false, WIFEXITED(status) ? fmt::format("exit status {}", WEXITSTATUS(status))
                                   : fmt::format("ended by signal {}", WTERMSIG(status))};
}

}  // namespace signorini::chart
