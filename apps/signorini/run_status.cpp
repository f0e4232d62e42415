#include "apps/signorini/run_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {
constexpr std::size_t cycles_of_rate = 6, fewest_cycles = 3;
}  // namespace

void RunStatus::step(const LoadStep& step, int of, double now) {
  if (number_ == 0) first_step_ = now;
  if (step.number != number_) this_step_ = now;
  number_ = step.number;
  of_ = of;
  step_.clear();
  short_step_.clear();
  if (of > 1) step_ = fmt::format("step {} of {}, ", number_, of);
  if (of > 1) short_step_ = fmt::format("step {}/{}, ", number_, of);
  if (of > 1 || step.halvings > 0) short_step_ += fmt::format("t {:.4g}; ", step.to);
  if (step.halvings > 0)
    step_ += fmt::format("its part from t = {:.6g} to {:.6g}; ", step.from, step.to);
  else if (of > 1)
    step_ += fmt::format("t = {:.6g}; ", step.to);
  phase("at work");
}

void RunStatus::phase(const std::string& what) {
  what_ = what;
  cycle_.clear();
  short_cycle_.clear();
  goal_ = {};
  errors_.clear();
}

void RunStatus::solving(const Goal& goal) {
  cycle_.clear();
  short_cycle_.clear();
  goal_ = goal;
  errors_.clear();
}

void RunStatus::cycle(const IterationRecord& record, double now) {
  cycle_ = fmt::format("iteration {}, residual {:.1e}, {} nodes in contact; ", record.iteration, record.residual,
                       record.contact_nodes);
  short_cycle_ =
      fmt::format("it. {}, res. {:.0e}, {} in contact; ", record.iteration, record.residual, record.contact_nodes);
  const double error = std::log(std::max(record.residual, record.algebraic_error));
  if (!std::isfinite(error)) return errors_.clear();
  errors_.emplace_back(now, error);
  if (errors_.size() > cycles_of_rate) errors_.pop_front();
}

std::optional<double> RunStatus::expected(double now) const {
  if (of_ > 1) {
    if (number_ < 2) return {};
    const double each = (this_step_ - first_step_) / (number_ - 1);
    const double late = std::max(0.0, now - this_step_ - each);  // what this one takes longer
    return first_step_ - begin_ + each * of_ + late;
  }
  if (!goal_.result || errors_.size() < fewest_cycles) return {};
  const auto& [since, before] = errors_.front();
  const auto& [last, error] = errors_.back();
  const double decay = (before - error) / (last - since), left = error - std::log(goal_.tolerance);
  if (!(decay > 0) || !std::isfinite(decay)) return {};
  return std::max(now, last + std::max(left, 0.0) / decay) - begin_;
}

std::string RunStatus::line(double now) const {
  const auto whole = expected(now);
  return fmt::format("{}{}; {}{:.0f} s {}", step_, what_, cycle_, now - begin_,
                     whole ? fmt::format("of about {:.0f} s", *whole) : "so far");
}

std::string RunStatus::line(double now, std::size_t width) const {
  std::string full = line(now);
  if (full.size() <= width) return full;
  const auto whole = expected(now);
  const std::string times = fmt::format("{:.0f}{} s", now - begin_, whole ? fmt::format("/{:.0f}", *whole) : "");
  std::string work = fmt::format("{}{}; {}", short_step_, what_.substr(0, what_.find(':')), short_cycle_);
  if (work.size() + times.size() > width) work.resize(width - std::min(width, times.size()));
  return (work + times).substr(0, width);
}

}  // namespace signorini
