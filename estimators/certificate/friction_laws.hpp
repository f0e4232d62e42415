#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/fem/model/model.hpp"
#include "core/sdk/friction.hpp"
#include "estimators/certificate/reasons.hpp"

namespace signorini {

/// Of an obstacle that was asked per area; none where it has no friction.
template <int B>
FrictionLaw law_of(const Obstacle<B>& obstacle, const LocalConstraint<B>& asked) {
  const Friction* friction = obstacle.friction();
  return friction ? friction->law(asked.data) : FrictionLaw{};
}

/// Tells where a law is not linear between two places.
inline void check_linear(const FrictionLaw& a, const FrictionLaw& b, const FrictionLaw& middle,
                         const std::string& origin, Reasons& reasons) {
  const auto is_mean = [](double from, double to, double between) {
    return std::fabs(between - (from + to) / 2) <= same_value * std::max(from, to);
  };
  if (!is_mean(a.bound, b.bound, middle.bound) || !is_mean(a.coefficient, b.coefficient, middle.coefficient))
    reasons.add(fmt::format("friction ({}) is not linear between nodes: its interpolation takes its place", origin));
}

inline void tell_frozen(const std::string& origin, Reasons& reasons) {
  reasons.add(
      fmt::format("friction ({}) follows the pressure: the bounds are those of the problem whose friction is at most "
                  "what the pressure found allows",
                  origin));
}

}  // namespace signorini
