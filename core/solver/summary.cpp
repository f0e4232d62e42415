#include "core/solver/summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "core/solver/attainable.hpp"

namespace signorini {

namespace {

template <class T>
void move_to_end(std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

// Levels are counted from the coarsest; a method without coarser ones does nothing there.
void add_idle_levels(const std::vector<LevelReport>& like, std::vector<LevelReport>& levels) {
  std::vector<LevelReport> idle;
  for (std::size_t k = 0; k + levels.size() < like.size(); ++k) idle.push_back({.vectors = like[k].vectors});
  levels.insert(levels.begin(), idle.begin(), idle.end());
}

}  // namespace

const char* outcome_name(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged:
      return "solved";
    case Outcome::rounding:
      return "limited by rounding";
    case Outcome::inaccurate:
      return "inaccurate";
    case Outcome::iteration_limit:
      return "iteration limit";
    case Outcome::interrupted:
      return "interrupted";
    case Outcome::unbounded:
      return "unbounded";
    case Outcome::stuck:
      return "stuck";
    case Outcome::failed:
      return "failed";
  }
  return "";
}

void Summary::append(Summary next) {
  for (IterationRecord& record : next.history) {
    if (!history.empty()) add_idle_levels(history.back().levels, record.levels);
    record.stage += stages.size();
  }
  next.iterations += iterations;
  next.options.method = options.method + ", then " + next.options.method;
  next.level_unknowns = std::move(level_unknowns);
  move_to_end(next.history, history);
  move_to_end(next.stages, stages);
  next.history = std::move(history);
  next.stages = std::move(stages);
  *this = std::move(next);
  find_linear_phase();
}

void Summary::add_rounding(double error, double tolerance) {
  if (!(error > 0)) return;
  rounding_error = std::hypot(rounding_error, error);
  algebraic_error = std::hypot(algebraic_error, error);
  if (!converged() || algebraic_error <= tolerance) return;
  outcome = rounding_error > inaccurate ? Outcome::inaccurate : Outcome::rounding;
  reason = fmt::format(
      "limited by rounding: residual {:.3e}, and an algebraic error of {:.3e} by rounding of the stiffness and of "
      "displacements that are large beside what deforms the body, tolerance {:.3e}",
      residual, algebraic_error, tolerance);
}

void Summary::put_in_front(std::vector<Stage> dropped) {
  for (IterationRecord& record : history) record.stage += dropped.size();
  move_to_end(stages, dropped);
  stages = std::move(dropped);
}

void Summary::find_linear_phase() {
  linear_phase_from = 0;
  for (auto it = history.rbegin(); it != history.rend() && it->changed == 0; ++it) linear_phase_from = it->iteration;
}

}  // namespace signorini
