#include "apps/signorini/interrupt.hpp"

#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>
#include <system_error>
#include <thread>

#include "core/base/error.hpp"
#include "core/base/interrupt.hpp"
#include "core/component/crash.hpp"
#include "core/io/atomic_files.hpp"

namespace signorini {
namespace {
constexpr int caught[] = {SIGINT, SIGTERM, SIGHUP};
sem_t requests;
std::atomic<bool> heard = false;

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
  request_interrupt();
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  set_all(action);
  sem_post(&requests);
}

[[noreturn]] void end_without(const std::string& plugin) {
  AtomicFiles::abandon_all();
  std::fprintf(stderr, "signorini: error: interrupted; nothing was written, for this plugin does not return: %s\n",
               plugin.c_str());
  _exit(static_cast<int>(Exit::interrupted));
}

/// Whatever else takes long looks whether to end now and then, be it after seconds: that is waited for.
void end_where_a_plugin_hangs() {
  constexpr useconds_t patience = 1000000;
  while (sem_wait(&requests) != 0) {
  }
  for (std::string before; !heard;) {
    usleep(patience);
    const std::string plugin = plugin_at_work();
    if (!plugin.empty() && plugin == before && !heard) end_without(plugin);
    before = plugin;
  }
}
}  // namespace

void catch_interrupts() {
  sem_init(&requests, 0, 0);
  try {
    std::thread(end_where_a_plugin_hangs).detach();
  } catch (const std::system_error&) {  // a second signal ends the program without it
  }
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  set_all(action);
}

bool interrupted() noexcept {
  const bool found = interrupt_requested();
  if (found) heard = true;
  return found;
}

void stop_if_interrupted() {
  if (interrupted()) throw Error(Exit::interrupted, "interrupted; nothing was written");
}

}  // namespace signorini
