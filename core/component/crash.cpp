#include "core/component/crash.hpp"

#include <elf.h>
#include <execinfo.h>
#include <link.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iterator>
#include <system_error>

#include "core/base/error.hpp"

namespace signorini {
namespace {

struct MappedFile {
  char file[512];
  std::uintptr_t begin, end;  // of its addresses
};

// Read by handlers of signals: never moved, counted when complete.
constexpr int most = 64;
MappedFile libraries[most];
std::atomic<int> count = 0;

const MappedFile* library_of(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  for (int k = 0; k < count.load(std::memory_order_acquire); ++k)
    if (libraries[k].begin <= at && at < libraries[k].end) return &libraries[k];
  return nullptr;
}

/// The plugin that was called last, null where none was.
const MappedFile* plugin_on_stack() {
  constexpr int deepest = 256;
  void* frames[deepest];
  const int depth = backtrace(frames, deepest);
  for (int k = 0; k < depth; ++k)
    if (const MappedFile* found = library_of(frames[k])) return found;
  return nullptr;
}

void write_text(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

[[noreturn]] void end_for(const MappedFile& plugin, const char* what) {
  write_text("signorini: error: ");
  write_text(plugin.file);
  write_text(": ");
  write_text(what);
  write_text("\n");
  _exit(static_cast<int>(Exit::plugin));
}

const char* name_of(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "the plugin reached outside its memory (SIGSEGV)";
    case SIGBUS:
      return "the plugin reached outside its memory (SIGBUS)";
    case SIGFPE:
      return "the plugin made a forbidden operation with integers (SIGFPE)";
    case SIGILL:
      return "the plugin met an illegal instruction: a trap, an abort, or code for another processor (SIGILL)";
    default:
      return "the plugin gave up (SIGABRT)";
  }
}

constexpr int caught[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
struct sigaction earlier[std::size(caught)];  // what a sanitizer had installed, say

// What is no plugin's is left to the handlers before: a fault happens again on return, a signal that was sent is sent
// again.
void on_signal(int signal, siginfo_t* info, void*) {
  for (std::size_t k = 0; k < std::size(caught); ++k) sigaction(caught[k], &earlier[k], nullptr);
  if (const MappedFile* plugin = plugin_on_stack()) end_for(*plugin, name_of(signal));
  const bool fault = info->si_code > 0 && info->si_code != SI_KERNEL;
  if (!fault) raise(signal);
}

std::terminate_handler before = nullptr;

[[noreturn]] void on_terminate() {
  if (const MappedFile* plugin = plugin_on_stack())
    end_for(*plugin, "an exception left a function of the plugin that must not throw");
  before();
  std::abort();
}

// exit() runs on the stack of its caller: that of a plugin would pass for success.
void on_exit_of_plugin() {
  if (const MappedFile* plugin = plugin_on_stack()) end_for(*plugin, "the plugin ended the program by exit()");
}

// Threads ignore this signal where nobody handles it.
constexpr int look_at_stack = SIGURG;
std::atomic<int> looked = 0;
std::atomic<const MappedFile*> at_work = nullptr;

void on_look(int) {
  const int error = errno;
  if (const MappedFile* plugin = plugin_on_stack()) at_work = plugin;
  ++looked;
  errno = error;
}

/// Has all other threads look; how many.
int ask_threads() {
  int asked = 0;
  std::error_code gone;
  for (std::filesystem::directory_iterator task("/proc/self/task", gone), end; task != end; task.increment(gone)) {
    const int thread = std::atoi(task->path().filename().c_str());
    if (thread == gettid()) continue;
    asked += syscall(SYS_tgkill, getpid(), thread, look_at_stack) == 0;
  }
  return asked;
}

}  // namespace

std::string plugin_at_work() {
  if (count.load() == 0) return {};
  struct sigaction look {};
  look.sa_handler = on_look;
  look.sa_flags = SA_RESTART;
  sigemptyset(&look.sa_mask);
  sigaction(look_at_stack, &look, nullptr);
  looked = 0;
  at_work = nullptr;
  const int asked = ask_threads();
  for (int wait = 0; looked < asked && wait < 100; ++wait) usleep(1000);
  const MappedFile* found = at_work;
  return found ? found->file : std::string();
}

void name_plugins_that_crash() {
  if (before) return;  // done
  void* frame[1];
  backtrace(frame, 1);  // loads what it needs, which a handler may not
  static char stack[1 << 16];
  stack_t alternative{};
  alternative.ss_sp = stack;
  alternative.ss_size = sizeof stack;
  sigaltstack(&alternative, nullptr);
  struct sigaction action {};
  action.sa_sigaction = on_signal;
  action.sa_flags = SA_SIGINFO | SA_NODEFER | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  for (std::size_t k = 0; k < std::size(caught); ++k) sigaction(caught[k], &action, &earlier[k]);
  std::atexit(on_exit_of_plugin);
  std::at_quick_exit(on_exit_of_plugin);
  before = std::set_terminate(on_terminate);
}

void remember_plugin(const std::filesystem::path& file, const void* address) {
  const int next = count.load();
  if (next == most || library_of(address)) return;
  MappedFile& library = libraries[next];
  std::strncpy(library.file, file.c_str(), sizeof library.file - 1);
  struct Search {
    std::uintptr_t address;
    MappedFile* library;
  } search{reinterpret_cast<std::uintptr_t>(address), &library};
  const auto visit = [](dl_phdr_info* info, std::size_t, void* data) {
    auto& wanted = *static_cast<Search*>(data);
    std::uintptr_t begin = UINTPTR_MAX, end = 0;
    for (int k = 0; k < info->dlpi_phnum; ++k)
      if (const auto& segment = info->dlpi_phdr[k]; segment.p_type == PT_LOAD) {
        begin = std::min<std::uintptr_t>(begin, info->dlpi_addr + segment.p_vaddr);
        end = std::max<std::uintptr_t>(end, info->dlpi_addr + segment.p_vaddr + segment.p_memsz);
      }
    if (wanted.address < begin || wanted.address >= end) return 0;
    wanted.library->begin = begin;
    wanted.library->end = end;
    return 1;
  };
  if (dl_iterate_phdr(visit, &search) == 1) count.store(next + 1, std::memory_order_release);
}

}  // namespace signorini
