#pragma once
#include <vector>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Where solves follow each other, loads and bounds mostly change by what they changed by before, and so does the
/// solution: of a start, the start with that added, and the start with so much of it as lowers the energy most where no
/// bound holds, takes the one with the least energy, each brought to the next admissible vector.
/// @param way what the last solve changed; empty: unknown
template <int B>
void go_on(const DiscreteProblem<B>& problem, const std::vector<double>& way, std::vector<double>& x);

}  // namespace signorini
