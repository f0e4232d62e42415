#include "apps/signorini/interrupt.hpp"

#include <csignal>

#include "core/base/error.hpp"

namespace signorini {
namespace {
volatile std::sig_atomic_t requested = 0;

void on_signal(int) {
  requested = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}
}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() noexcept { return requested != 0; }

void stop_if_interrupted() {
  if (interrupted()) throw Error(Exit::interrupted, "interrupted; nothing was written");
}

}  // namespace signorini
