#pragma once
#include <vector>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Whether d is a direction without energy, but for rounding, along which b does work and that no bound ends: then
/// 1/2 x'Ax - b'x has no minimum. The coarse solver finds such directions where the coarsest level holds them exactly;
/// where it does not, iterates run away along them.
template <int B>
bool falls_forever(const DiscreteProblem<B>& problem, const std::vector<double>& d);

}  // namespace signorini
