#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/signorini/heartbeat.hpp"
#include "driver/progress.hpp"

namespace signorini {

/// Lines on standard error while long work goes on. On a terminal there is one for each phase and cycle; those of
/// cycles take each other's place and go at the end: the table of results has them all. Where nothing is printed for
/// some seconds, a line says what goes on; in files and pipes there are only these.
class Console final : public Progress {
 public:
  explicit Console(bool quiet);
  ~Console() override;
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void phase(const std::string& what) const override;
  void cycle(const IterationRecord& record) const override;
  /// When the user asked to end.
  bool interrupted() const override;

 private:
  void clear() const;

  bool terminal_ = false;
  mutable bool open_ = false;             // a cycle's line is the last one
  std::unique_ptr<Heartbeat> heartbeat_;  // none where nothing is shown
};

/// What a solve did: the convergence table, why it stopped, and its size.
/// @param solved this solve and all before it
void print_summary(const Summary& summary, bool solved, const std::string& reason);

/// Calls `print`, which prints on standard output what results are that are in their files already: where it cannot be
/// written there is a warning, and nothing is printed from then on.
void print_of_written(const std::function<void()>& print);

/// Error(Exit::not_converged) where results were written that are no solution.
void fail_unless_solved(bool solved, const std::string& reason);

/// On standard error, a line each.
void print_warnings(const std::vector<std::string>& warnings);

/// Largest memory the program has had so far, in 2^20 bytes.
double peak_memory_mb();

}  // namespace signorini
