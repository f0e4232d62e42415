#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/signorini/heartbeat.hpp"
#include "apps/signorini/run_status.hpp"
#include "core/io/warning.hpp"
#include "driver/scene/progress.hpp"

namespace signorini {

/// What of its results a run prints on standard output while they are made.
enum class Live { nothing, tables };

/// Says on standard error how long work goes on: on a terminal in one line that is always up to date, elsewhere in a
/// line every ten seconds. The tables of results appear on standard output row by row.
class Console final : public Progress {
 public:
  /// @param title is printed before the first row, or by print_title()
  explicit Console(bool quiet, Live live = Live::nothing, std::string title = {});
  ~Console() override;
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void step(const LoadStep& step, int of) const override;
  void phase(const std::string& what) const override;
  void solving(const Goal& goal) const override;
  void cycle(const IterationRecord& record) const override;
  /// When the user asked to end.
  bool interrupted() const override;

  /// Unless that was done.
  void print_title() const;
  /// A row of a table; does nothing where nothing is printed.
  void print_row(const std::string& row) const;
  /// Whether the table of cycles shows all of them, as the last one.
  bool has_shown(const std::vector<IterationRecord>& history) const;
  /// Nothing is said from now on.
  void end() const;

 private:
  void change(const std::function<void()>& what) const;
  void clear() const;
  void show() const;
  void print_cycle(const IterationRecord& record) const;
  void print_line(const std::string& line) const;

  bool terminal_ = false, tables_ = false;
  mutable std::string title_;
  mutable bool open_ = false;                   // the line of progress is the last one
  mutable std::vector<IterationRecord> shown_;  // of the solve at hand, without their levels
  mutable bool several_ = false;                // steps: they have a table of their own
  mutable RunStatus status_;
  mutable std::unique_ptr<Heartbeat> heartbeat_;  // none where nothing is shown
};

/// What a solve did: the convergence table where the console has not shown it, why it stopped, and its size.
/// @param solved this solve and all before it
void print_summary(const Console& console, const Summary& summary, bool solved, const std::string& reason);

/// Calls `print`, which prints on standard output what results are that are in their files already: where it cannot be
/// written there is a warning, and nothing is printed from then on.
void print_of_written(const std::function<void()>& print);

/// Error(Exit::not_converged) where results were written that are no solution.
void fail_unless_solved(bool solved, const std::string& reason);

/// On standard error, a line each.
void print_warnings(const Warnings& warnings);

/// Largest memory the program has had so far, in 2^20 bytes.
double peak_memory_mb();

}  // namespace signorini
