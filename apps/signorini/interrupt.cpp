#include "apps/signorini/interrupt.hpp"

#include <csignal>

#include "core/base/error.hpp"

namespace signorini {
namespace {
constexpr int caught[] = {SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t requested = 0;

/// Whether the program was started by `nohup`.
bool is_refused(int number) {
  struct sigaction found {};
  return number == SIGHUP && sigaction(number, nullptr, &found) == 0 && found.sa_handler == SIG_IGN;
}

void set_all(const struct sigaction& action) {
  for (const int number : caught)
    if (!is_refused(number)) sigaction(number, &action, nullptr);
}

void on_signal(int) {
  requested = 1;
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  set_all(action);
}
}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  set_all(action);
}

bool interrupted() noexcept { return requested != 0; }

void stop_if_interrupted() {
  if (interrupted()) throw Error(Exit::interrupted, "interrupted; nothing was written");
}

}  // namespace signorini
