#include "core/component/trial.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/interrupt.hpp"
#include "core/base/stopwatch.hpp"

namespace signorini {
namespace {

// Unlike what programs end with, for `work` may end the copy with any status.
constexpr int finished = 94, terminated = 95;
constexpr int loader_gave_up = 127;  // of the loader of the system

[[noreturn]] void try_out(const std::function<void()>& work) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM, SIGHUP})
    std::signal(signal, SIG_DFL);
  const rlimit none{};
  setrlimit(RLIMIT_CORE, &none);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  std::set_terminate([] { _exit(terminated); });
  try {
    work();
  } catch (...) {  // said by the process itself
  }
  _exit(finished);
}

/// The status of a child once it has ended, by itself or killed: for its delay, which leaves `late` true, or when this
/// process is to end.
std::optional<int> status_of(pid_t child, double patience, bool& late) {
  constexpr useconds_t shortest = 100, longest = 5000;
  const Stopwatch watch;
  bool killed = false;
  int status = 0;
  for (useconds_t pause = shortest;; pause = std::min(2 * pause, longest)) {
    const pid_t ended = waitpid(child, &status, killed ? 0 : WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) return {};
    if (killed) continue;
    late = watch.elapsed() > patience;
    killed = late || interrupt_requested();
    if (killed)
      kill(child, SIGKILL);
    else
      usleep(pause);
  }
}

}  // namespace

std::string fatal_end(const std::function<void()>& work, double patience) {
  const pid_t copy = fork();
  if (copy < 0) return {};
  if (copy == 0) try_out(work);
  bool late = false;
  const std::optional<int> ended = status_of(copy, patience, late);
  if (interrupt_requested()) throw Error(Exit::interrupted, "interrupted; nothing was written");
  if (!ended) return {};
  if (late) return fmt::format("no end within {:g} seconds", patience);
  const int status = *ended;
  if (WIFSIGNALED(status)) return fmt::format("a crash ({})", strsignal(WTERMSIG(status)));
  switch (const int code = WEXITSTATUS(status)) {
    case finished:
      return {};
    case terminated:
      return "an exception that nothing catches";
    case loader_gave_up:
      return "the loader of the system giving up";
    default:
      return fmt::format("the program being ended with status {}", code);
  }
}

}  // namespace signorini
