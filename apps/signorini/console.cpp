#include "apps/signorini/console.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <system_error>

#include "apps/signorini/interrupt.hpp"
#include "core/base/error.hpp"
#include "core/base/proc.hpp"
#include "core/io/convergence.hpp"

namespace signorini {

namespace {
// Seconds.
constexpr double longest_silence = 5, longest_silence_of_logs = 10;

constexpr const char* not_solved = "not solved: ";
}  // namespace

Console::Console(bool quiet) {
  if (quiet) return;
  terminal_ = isatty(STDERR_FILENO);
  const double longest = terminal_ ? longest_silence : longest_silence_of_logs;
  heartbeat_ = std::make_unique<Heartbeat>(longest, [this](const std::string& line) {
    clear();
    fmt::print(stderr, "{}\n", line);
  });
}

Console::~Console() {
  heartbeat_.reset();
  clear();
}

void Console::clear() const {
  if (open_) std::fputs("\r\x1b[K", stderr);
  open_ = false;
}

void Console::phase(const std::string& what) const {
  if (!heartbeat_) return;
  if (!terminal_) return heartbeat_->begin(what);
  heartbeat_->begin(what, [&] {
    clear();
    fmt::print(stderr, "{}\n", what);
  });
}

bool Console::interrupted() const { return signorini::interrupted(); }

void Console::cycle(const IterationRecord& record) const {
  if (!heartbeat_ || !terminal_) return;
  heartbeat_->speak([&] {
    clear();
    fmt::print(stderr, "{}", convergence_row(record));
    open_ = true;
  });
}

namespace {

/// One line.
std::string described(const Stage& stage) {
  std::string text = stage.method;
  if (!stage.linear.empty()) text += " with " + stage.linear;
  text += fmt::format(": {:.2f} s", stage.seconds);
  if (stage.iterations > 0) text += fmt::format(", {} iterations", stage.iterations);
  if (stage.linear_solves > 0)
    text += fmt::format(", {} linear solves, {} factorisations", stage.linear_solves, stage.factorisations);
  text += stage.kept ? "; " : "; dropped, ";
  const std::string outcome = outcome_name(stage.outcome);
  return text + (stage.reason.starts_with(outcome) ? "" : outcome + ": ") + stage.reason + '\n';
}

}  // namespace

void print_summary(const Summary& summary, bool solved, const std::string& reason) {
  const std::vector<Index>& unknowns = summary.level_unknowns;
  fmt::print("{}", convergence_table(summary.history));
  fmt::print("{}{}\n", solved ? "solved: " : not_solved, reason);
  if (summary.stages.size() > 1)
    for (const Stage& stage : summary.stages) fmt::print("{}", described(stage));
  fmt::print("{} unknowns on {} levels ({} to {}), {} iterations, rate {}, energy {:.10g}\n",
             unknowns.empty() ? 0 : unknowns.back(), unknowns.size(), summary.level_number(0), summary.finest_level,
             summary.iterations, std::isnan(summary.rate) ? "unknown" : fmt::format("{:.3f}", summary.rate),
             summary.energy);
}

void print_of_written(const std::function<void()>& print) {
  try {
    print();
  } catch (const std::system_error&) {  // of fmt, when standard output fails
  }
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return;
  if (!std::freopen("/dev/null", "w", stdout)) std::clearerr(stdout);
  print_warnings({"standard output: cannot be written: is the disk full? The results are in their files."});
}

void fail_unless_solved(bool solved, const std::string& reason) {
  if (!solved) throw Error(Exit::not_converged, not_solved + reason);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "signorini: warning: {}\n", warning);
}

double peak_memory_mb() {
  constexpr double megabyte = 1024 * 1024;
  if (const auto bytes = proc_bytes("/proc/self/status", "VmHWM")) return *bytes / megabyte;
  rusage usage{};  // no less than what the process had that this program was started in
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<double>(usage.ru_maxrss) / megabyte;
}

}  // namespace signorini
