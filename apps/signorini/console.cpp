#include "apps/signorini/console.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <system_error>
#include <utility>

#include "apps/signorini/interrupt.hpp"
#include "apps/signorini/text.hpp"
#include "core/base/clock.hpp"
#include "core/base/error.hpp"
#include "core/base/proc.hpp"
#include "core/io/convergence.hpp"
#include "core/io/warning_kinds.hpp"

namespace signorini {

namespace {
// Seconds.
constexpr double longest_silence = 1, longest_silence_of_logs = 10;

constexpr const char* not_solved = "not solved: ";

/// Whether two records of a cycle print the same, but for the energy: that of earlier cycles is made more accurate
/// later.
bool is_same(const IterationRecord& a, const IterationRecord& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return a.iteration == b.iteration && same(a.residual, b.residual) && same(a.algebraic_error, b.algebraic_error) &&
         a.contact_nodes == b.contact_nodes && a.changed == b.changed;
}

}  // namespace

Console::Console(bool quiet, Live live, std::string title) : title_(std::move(title)), status_(seconds()) {
  if (quiet) return;
  tables_ = live == Live::tables;
  if (tables_) std::signal(SIGPIPE, SIG_IGN);  // a reader who has seen enough ends no solve
  terminal_ = isatty(STDERR_FILENO) != 0;
  heartbeat_ = std::make_unique<Heartbeat>(terminal_ ? longest_silence : longest_silence_of_logs, [this] {
    if (terminal_) return show();
    fmt::print(stderr, "{}\n", status_.line(seconds()));
  });
}

Console::~Console() { end(); }

void Console::end() const {
  heartbeat_.reset();
  clear();
}

void Console::clear() const {
  if (open_) std::fputs("\r\x1b[K", stderr);
  open_ = false;
}

/// In place of the last one, so that it fits.
void Console::show() const {
  const int width = terminal_width(STDERR_FILENO);
  const std::string line =
      width > 1 ? status_.line(seconds(), static_cast<std::size_t>(width) - 1) : status_.line(seconds());
  clear();
  std::fputs(line.c_str(), stderr);
  open_ = true;
}

void Console::change(const std::function<void()>& what) const {
  if (!heartbeat_) return;
  if (!terminal_) return heartbeat_->note(what);
  heartbeat_->speak([&] {
    what();
    show();
  });
}

void Console::step(const LoadStep& step, int of) const {
  several_ = of > 1;
  change([&] { status_.step(step, of, seconds()); });
}

void Console::phase(const std::string& what) const {
  change([&] { status_.phase(what); });
}

void Console::solving(const Goal& goal) const {
  shown_.clear();
  change([&] { status_.solving(goal); });
}

bool Console::interrupted() const { return signorini::interrupted(); }

void Console::cycle(const IterationRecord& record) const {
  change([&] {
    status_.cycle(record, seconds());
    if (tables_ && !several_ && status_.goal().result) print_cycle(record);
  });
}

void Console::print_cycle(const IterationRecord& record) const {
  IterationRecord row = record;
  row.levels.clear();
  row.energy *= status_.goal().copies;
  if (shown_.empty()) print_line(convergence_heading());
  print_line(convergence_row(row));
  shown_.push_back(std::move(row));
}

void Console::print_title() const {
  if (!title_.empty()) std::fputs((std::exchange(title_, {}) + '\n').c_str(), stdout);
}

/// Where it cannot be written print_of_written() says so in the end.
void Console::print_line(const std::string& line) const {
  clear();
  print_title();
  std::fputs((line + '\n').c_str(), stdout);
  std::fflush(stdout);
}

void Console::print_row(const std::string& row) const {
  if (tables_) change([&] { print_line(row); });
}

bool Console::has_shown(const std::vector<IterationRecord>& history) const {
  return !shown_.empty() && std::ranges::equal(shown_, history, is_same);
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

void print_summary(const Console& console, const Summary& summary, bool solved, const std::string& reason) {
  const std::vector<Index>& unknowns = summary.level_unknowns;
  if (!console.has_shown(summary.history)) fmt::print("{}", convergence_table(summary.history));
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
  print_warnings({warning<"no-output">()});
}

void fail_unless_solved(bool solved, const std::string& reason) {
  if (!solved) throw Error(Exit::not_converged, not_solved + reason);
}

void print_warnings(const Warnings& warnings) {
  for (const Warning& warning : warnings) fmt::print(stderr, "signorini: warning: {}\n", warning.text);
}

double peak_memory_mb() {
  constexpr double megabyte = 1024 * 1024;
  if (const auto bytes = proc_bytes("/proc/self/status", "VmHWM")) return *bytes / megabyte;
  rusage usage{};  // no less than what the process had that this program was started in
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<double>(usage.ru_maxrss) / megabyte;
}

}  // namespace signorini
