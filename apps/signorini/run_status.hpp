#pragma once
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "driver/scene/progress.hpp"

namespace signorini {

/// What a run is at, in a line, and how long it may still take. Times are seconds of any one clock.
class RunStatus {
 public:
  explicit RunStatus(double now) : begin_(now) {}

  void step(const LoadStep& step, int of, double now);
  void phase(const std::string& what);
  void solving(const Goal& goal);
  void cycle(const IterationRecord& record, double now);

  const Goal& goal() const { return goal_; }
  /// "step 3 of 30, t = 0.1; level 1: 4836 vertices; iteration 7, residual 2.1e-05, 130 nodes in contact; 50 s of about
  /// 400 s"
  std::string line(double now) const;
  /// The same in at most `width` characters: shorter words where it does not fit, and the times in any case.
  /// "step 3/30, t 0.1; level 1; it. 7, res. 2e-05, 130 in contact; 50/400 s"
  std::string line(double now, std::size_t width) const;
  /// Of the whole run, if that can be told: from the steps that are finished, or from how fast the error goes down.
  std::optional<double> expected(double now) const;

 private:
  double begin_;
  std::string step_, what_ = "at work", cycle_;
  std::string short_step_, short_cycle_;  // the same for a narrow terminal
  int number_ = 0, of_ = 1;
  double first_step_ = 0, this_step_ = 0;  // when they began
  Goal goal_;
  std::deque<std::pair<double, double>> errors_;  // of the last cycles towards the result: when, and their logarithms
};

}  // namespace signorini
