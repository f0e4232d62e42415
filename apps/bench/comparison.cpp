#include "apps/bench/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"

namespace signorini::bench {

namespace {

constexpr int repetitions = 3;
constexpr double close = 1.1;      // times the best: what takes longer is not repeated
constexpr double hopeless = 1.25;  // times the best so far: methods that take longer are tried with no other steps
constexpr int longest = 3;         // times the cycles of the default, after which a candidate has failed

std::string name_of(const Overrides& settings) {
  std::string name;
  for (const std::string& s : settings) name += (name.empty() ? "" : ", ") + s.substr(s.find('.') + 1);
  return name;
}

}  // namespace

Overrides joined(Overrides all, const Overrides& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Comparison::Comparison(Run run) : run_(std::move(run)) {
  automatic_ = fastest({}, std::numeric_limits<double>::infinity());
}

void Comparison::try_method(const Overrides& method, const std::vector<Overrides>& lists) {
  if (try_settings(method).seconds > hopeless * std::min(best_.seconds, automatic_.seconds)) return;
  for (const Overrides& list : lists)
    if (!list.empty()) try_settings(joined(method, list));
}

void Comparison::confirm() {
  if (!automatic_.converged || !best_.converged) return;
  automatic_.seconds = best_.seconds = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repetitions; ++k) {
    automatic_.seconds = std::min(automatic_.seconds, run_({}).seconds);
    best_.seconds = std::min(best_.seconds, run_(best_settings_).seconds);
  }
}

double Comparison::ratio() const {
  if (!automatic_.converged) return std::numeric_limits<double>::infinity();
  return best_.converged ? automatic_.seconds / best_.seconds : 0;
}

std::string Comparison::row() const {
  const bool both = automatic_.converged && best_.converged;
  return fmt::format("{}{} | {} | {} | {} | {}", automatic_.cycles, automatic_.converged ? "" : " (limit)",
                     best_.converged ? name_of(best_settings_) : "none", best_.cycles, failed_,
                     both ? fmt::format("{:.2f}", ratio()) : "none");
}

// Repeated while it takes at most `limit` seconds.
Trial Comparison::fastest(const Overrides& settings, double limit) const {
  Trial best;
  for (int k = 0; k < repetitions; ++k) {
    try {
      const Trial next = run_(settings);
      if (k == 0 || next.seconds < best.seconds) best = next;
    } catch (const Error&) {
      break;
    }
    if (!best.converged || best.seconds > limit) break;
  }
  return best;
}

Trial Comparison::try_settings(const Overrides& settings) {
  const std::string limit = fmt::format("solver.max_iterations={}", longest * std::max(automatic_.cycles, 4));
  const Trial t = fastest(joined(settings, {limit}), close * std::min(best_.seconds, automatic_.seconds));
  failed_ += !t.converged;
  if (t.converged && t.seconds < best_.seconds) best_ = t, best_settings_ = settings;
  return t;
}

}  // namespace signorini::bench
