#include "driver/reports/error_estimate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "amg/linear/algebraic_cycle.hpp"
#include "core/solver/masked_cg.hpp"

namespace signorini {
namespace {

constexpr double EstimateParts::*all_parts[] = {&EstimateParts::discretisation, &EstimateParts::algebra,
                                                &EstimateParts::contact,        &EstimateParts::oscillation,
                                                &EstimateParts::geometry,       &EstimateParts::friction};

void add(const EstimateReport& from, EstimateReport& to) {
  to.lower += from.lower;
  to.upper += from.upper;
  to.estimated += from.estimated;
  to.total += from.total;
  to.lifted += from.lifted;
  to.energy += from.energy;
  to.seconds += from.seconds;
  to.guaranteed = to.guaranteed && from.guaranteed;
  for (const std::string& reason : from.reasons)
    if (std::ranges::find(to.reasons, reason) == to.reasons.end()) to.reasons.push_back(reason);
  for (const auto part : all_parts) to.parts.*part += from.parts.*part;
}

}  // namespace

template <int B>
LinearSolve<B> rough_solve(const Registry& registry) {
  return [&registry](const DiscreteProblem<B>& problem, std::vector<double>& x) {
    constexpr CgLimits limits{.reduction = 1e-4, .iterations = 100};  // the tree carries the rest far
    AlgebraicCycle<B> cycle(registry, problem.A, 1);
    std::vector<double> r = problem.b;
    const auto precondition = [&](const std::vector<double>& from, std::vector<double>& to) {
      cycle.apply(from.data(), to.data());
      apply_mask<B>(problem.fixed, to);
    };
    return masked_cg<B>(problem.A, problem.fixed, precondition, limits, r, x).converged;
  };
}

template LinearSolve<1> rough_solve(const Registry&);
template LinearSolve<2> rough_solve(const Registry&);
template LinearSolve<3> rough_solve(const Registry&);

Estimate of_whole(Estimate estimate, int copies) {
  estimate.lower *= copies;
  estimate.upper *= copies;
  estimate.estimated *= copies;
  estimate.total *= copies;
  estimate.lifted *= copies;
  estimate.energy *= copies;
  for (const auto part : all_parts) estimate.parts.*part *= copies;
  return estimate;
}

std::optional<EstimateReport> added_up(const std::vector<std::optional<EstimateReport>>& bodies) {
  if (bodies.empty() || !std::ranges::all_of(bodies, [](const auto& body) { return body.has_value(); })) return {};
  EstimateReport all = *bodies.front();
  for (auto body = bodies.begin() + 1; body != bodies.end(); ++body) add(**body, all);
  return all;
}

std::string error_text(const EstimateReport& estimate) {
  const std::string why =
      estimate.guaranteed ? "guaranteed" : fmt::format("not guaranteed: {}", fmt::join(estimate.reasons, "; "));
  if (!std::isfinite(estimate.relative_estimated()))
    return fmt::format("energy error not known: {}", fmt::join(estimate.reasons, "; "));
  if (!std::isfinite(estimate.relative_upper()))
    return fmt::format("energy error estimated as {:.2g} %, {}", 100 * estimate.relative_estimated(), why);
  return fmt::format("energy error between {:.2g} % and {:.2g} %, {}", 100 * estimate.relative_lower(),
                     100 * estimate.relative_upper(), why);
}

}  // namespace signorini
