#include "apps/bench/peers/child.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "core/base/error.hpp"

namespace signorini::bench {

ChildRun run_child(const std::string& command, double limit) {
  const std::string line = fmt::format("OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 timeout {} {}", limit, command);
  const pid_t child = fork();
  if (child < 0) throw Error(Exit::input, "no further process can be started");
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0, seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

bool has_program(const std::string& name) {
  return std::system(fmt::format("command -v {} > /dev/null", name).c_str()) == 0;
}

}  // namespace signorini::bench
