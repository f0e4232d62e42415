#pragma once
#include <vector>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Of admissible vectors the number of the one with least energy, the last one of such: J(a) - J(b) = -(a - b)'r with
/// the residual r in the middle between them, all in one pass over the matrix. Functionals that follow the solution are
/// as they were after the last load step: with what presses less presses there is less friction, too, and all that is
/// held would let go.
template <int B>
std::size_t least_energy(const DiscreteProblem<B>& problem, const std::vector<std::vector<double>>& vectors);

}  // namespace signorini
