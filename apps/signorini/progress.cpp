#include "apps/signorini/progress.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "core/io/convergence.hpp"

namespace signorini {
namespace {
double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
}  // namespace

Progress::Progress(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO)) {}

void Progress::phase(const std::string& what) const {
  if (shown_) fmt::print(stderr, "{}\n", what);
}

void Progress::cycle(const IterationRecord& record) const {
  if (shown_) fmt::print(stderr, "{}\n", convergence_row(record));
}

void print_summary(const Summary& summary, bool solved) {
  const std::vector<Index>& unknowns = summary.level_unknowns;
  fmt::print("{}", convergence_table(summary.history));
  fmt::print("{}: {}\n", solved ? "solved" : "not solved", summary.reason);
  fmt::print("{} unknowns on {} levels, {} iterations, rate {:.3f}, energy {:.10g}\n",
             unknowns.empty() ? 0 : unknowns.back(), unknowns.size(), summary.iterations, summary.rate, summary.energy);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "signorini: warning: {}\n", warning);
}

Stopwatch::Stopwatch() : start_(now()) {}

double Stopwatch::elapsed() const { return now() - start_; }

double Stopwatch::lap() {
  const double seconds = elapsed();
  start_ += seconds;
  return seconds;
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // kilobytes on Linux
}

}  // namespace signorini
