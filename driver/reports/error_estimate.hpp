#pragma once
#include <string>

#include "core/component/registry.hpp"
#include "core/io/report.hpp"
#include "estimators/estimator.hpp"

namespace signorini {

/// Conjugate gradients, preconditioned by a cycle on levels that the matrix gives.
template <int B>
LinearSolve<B> rough_solve(const Registry& registry);

/// Of the whole that a mesh with planes of symmetry stands for.
Estimate of_whole(Estimate estimate, int copies);

/// Of bodies that are solved apart; nothing where one of them has none.
std::optional<EstimateReport> added_up(const std::vector<std::optional<EstimateReport>>& bodies);

/// "energy error between 0.8 % and 1.9 %, guaranteed"
std::string error_text(const EstimateReport& estimate);

}  // namespace signorini
