#include "driver/reports/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "driver/reports/error_estimate.hpp"

namespace signorini {
namespace {

template <class T>
void append(std::vector<T>& list, std::vector<T> more) {
  list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

bool is_worse(Outcome a, Outcome b) {
  const auto badness = [](Outcome outcome) {
    return outcome == Outcome::converged ? 0 : outcome == Outcome::rounding ? 1 : 2;
  };
  return badness(a) > badness(b);
}

/// Levels count from the finest.
void add_levels(Summary& all, const Summary& next) {
  if (next.level_unknowns.size() > all.level_unknowns.size())
    all.level_unknowns.insert(all.level_unknowns.begin(), next.level_unknowns.size() - all.level_unknowns.size(), 0);
  for (std::size_t k = 1; k <= next.level_unknowns.size(); ++k)
    *(all.level_unknowns.end() - static_cast<Offset>(k)) += *(next.level_unknowns.end() - static_cast<Offset>(k));
  all.finest_level = std::max(all.finest_level, next.finest_level);
}

void add_history(Summary& all, std::vector<IterationRecord> next) {
  const int steps = all.history.empty() ? 0 : all.history.back().iteration;
  for (IterationRecord& record : next) {
    record.iteration += steps;
    record.stage += all.stages.size();
  }
  append(all.history, std::move(next));
}

void add(Summary& all, Summary next) {
  add_levels(all, next);
  add_history(all, std::move(next.history));
  append(all.stages, std::move(next.stages));
  if (is_worse(next.outcome, all.outcome)) all.outcome = next.outcome;
  all.iterations += next.iterations;
  all.residual = std::max(all.residual, next.residual);
  all.algebraic_error = std::max(all.algebraic_error, next.algebraic_error);
  all.rounding_error = std::max(all.rounding_error, next.rounding_error);
  all.rate = std::fmax(all.rate, next.rate);
  all.energy += next.energy;
  if (all.options.method != next.options.method) all.options.method += "; " + next.options.method;
  all.setup_seconds += next.setup_seconds;
  all.solve_seconds += next.solve_seconds;
}

/// Coarser levels that a body has not are idle.
void complete_levels(Summary& all) {
  for (IterationRecord& record : all.history)
    record.levels.insert(record.levels.begin(), all.level_unknowns.size() - record.levels.size(), LevelReport{});
}

Summary merged(const std::vector<BodyReport>& bodies) {
  Summary all = bodies.front().summary;
  std::string reason = fmt::format("{}: {}", bodies.front().name, all.reason);
  for (auto body = bodies.begin() + 1; body != bodies.end(); ++body) {
    add(all, body->summary);
    reason += fmt::format("; {}: {}", body->name, body->summary.reason);
  }
  all.reason = std::move(reason);
  all.find_linear_phase();
  complete_levels(all);
  return all;
}

}  // namespace

StepReport merged(const Scene& scene, std::vector<StepReport> bodies) {
  std::vector<std::optional<EstimateReport>> estimates;
  for (const StepReport& body : bodies) estimates.push_back(body.estimate);
  StepReport all = std::move(bodies.front());
  if (bodies.size() == 1) return all;
  all.estimate = added_up(estimates);
  for (auto next = bodies.begin() + 1; next != bodies.end(); ++next) {
    append(all.contact, std::move(next->contact));
    append(all.probes, std::move(next->probes));
    append(all.applied, std::move(next->applied));
    append(all.reactions, std::move(next->reactions));
    append(all.springs, std::move(next->springs));
    append(all.rigid, std::move(next->rigid));
    append(all.balance, std::move(next->balance));
    append(all.bodies, std::move(next->bodies));
    append(all.undetermined, std::move(next->undetermined));
  }
  std::ranges::sort(all.contact, {}, &ContactReport::obstacle);
  std::ranges::sort(all.applied, {}, &ForceReport::number);
  std::ranges::sort(all.reactions, {}, &ForceReport::number);
  std::ranges::sort(all.springs, {}, &ForceReport::number);
  std::ranges::sort(all.rigid, {}, &RigidReport::number);
  std::ranges::sort(all.probes, {}, [&](const ProbeReport& probe) {
    return std::ranges::find(scene.probes, probe.name, &Scene::Probe::name) - scene.probes.begin();
  });
  all.summary = merged(all.bodies);
  return all;
}

}  // namespace signorini
