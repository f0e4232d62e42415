#pragma once
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/folder.hpp"

namespace signorini::test {

namespace fs = std::filesystem;

inline std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// How a program ended; `status` is 128 + signal where a signal ended it.
struct Ended {
  int status;
  std::string out, err;
  long megabytes = 0;  ///< of memory, at most
};

/// Each test in a folder of its own, where the program runs.
class Program : public Folder {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  std::string columns_ = "1000";  ///< so that no line is broken; "": as without it

  pid_t start(const std::string& program, std::vector<std::string> arguments) const {
    const std::string path = std::string(SIGNORINI_BINARY_DIR) + "/bin/" + program;
    std::vector<char*> argv{const_cast<char*>(path.c_str())};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    if (chdir(folder_.c_str()) != 0) _exit(126);
    setenv("COLUMNS", columns_.c_str(), 1);
    dup2(open((folder_ / ".out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open((folder_ / ".err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    execv(path.c_str(), argv.data());
    _exit(127);
  }

  /// Waits until something holds of a running program. What ends before, or never comes to it, fails the test.
  template <class Condition>
  static void wait_until(pid_t child, const Condition& condition) {
    while (!condition()) {
      siginfo_t ended{};
      waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
      if (ended.si_pid == child) return ADD_FAILURE() << "the program ended too soon", void();
      usleep(1000);
    }
  }

  /// Megabytes of memory that a program takes.
  static long megabytes(pid_t child) {
    long pages = 0, resident = 0;
    std::ifstream("/proc/" + std::to_string(child) + "/statm") >> pages >> resident;
    return resident * sysconf(_SC_PAGESIZE) / 1000000;
  }

  Ended wait_for(pid_t child) const {
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(folder_ / ".out"),
            read(folder_ / ".err"), usage.ru_maxrss / 1000};
  }

  Ended signorini(std::vector<std::string> arguments) const {
    return wait_for(start("signorini", std::move(arguments)));
  }

  /// Names in the folder below, but for the captured output and scenes.
  std::vector<std::string> written(const std::string& below = "") const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / below)) {
      const std::string name = entry.path().filename();
      if (name != ".out" && name != ".err" && entry.path().extension() != ".toml") names.push_back(name);
    }
    return names;
  }

  nlohmann::json report(const std::string& folder) const {
    return nlohmann::json::parse(read(folder_ / folder / "report.json"));
  }
};

/// How well reports agree with a definition of their schema: what python says.
inline std::string wrong_with(const std::vector<fs::path>& reports, const std::string& definition = "") {
  const std::string tests = SIGNORINI_SOURCE_DIR "/tests/docs/",
                    schema = SIGNORINI_SOURCE_DIR "/docs/report.schema.json";
  std::string command = "/usr/bin/python3 '" + tests + "validate_reports.py' '" + schema + "#" + definition + "'";
  for (const fs::path& report : reports) command += " '" + report.string() + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>&1").c_str(), "r"), pclose);
  std::string said;
  for (int c; (c = std::fgetc(pipe.get())) != EOF;) said += static_cast<char>(c);
  return said;
}

/// A membrane over an obstacle; solved in a moment.
inline const std::string membrane = R"(title = "membrane"
[[body]]
name = "m"
shape = "rectangle"
from = [-1, -1]
to = [1, 1]
cells = [4, 4]
equation = "diffusion"
[[fix]]
body = "m"
on = "boundary"
value = [0]
[[obstacle]]
type = "scalar"
body = "m"
lower = "0.5 - x^2 - y^2"
[refine]
uniform = 3
[[probe]]
name = "centre"
body = "m"
at = [0, 0]
)";

/// A block pressed by a flat punch with side walls: uniform stress, all of the top in contact.
inline const std::string punch = R"(title = "punch"
[[body]]
name = "b"
shape = "box"
from = [0, 0, 0]
to = [1, 1, 1]
cells = [2, 2, 2]
order = 1
young = 1.0
poisson = 0.25
[[fix]]
body = "b"
on = "bottom"
frame = "normal"
value = [0, "free", "free"]
[[fix]]
body = "b"
on = "left"
value = [0, "free", "free"]
[[fix]]
body = "b"
on = "right"
value = [0, "free", "free"]
[[fix]]
body = "b"
on = "front"
value = ["free", 0, "free"]
[[fix]]
body = "b"
on = "back"
value = ["free", 0, "free"]
[[obstacle]]
type = "contact"
body = "b"
on = "top"
shape = "plane"
point = [0, 0, "1 - 0.01 * t"]
normal = [0, 0, -1]
[refine]
uniform = 1
[[probe]]
name = "top"
body = "b"
at = [0.5, 0.5, 1]
)";

}  // namespace signorini::test
