#pragma once
#include <span>

#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// The bounds of n unknowns in blocks of size B; empty spans: none.
/// Error(Exit::input) for sizes that do not fit and for NaN, Error(Exit::no_solution) where no number lies between the
/// bounds of a row, counted from 1.
template <int B>
Constraints<B> box(std::size_t n, std::span<const double> lower, std::span<const double> upper);

}  // namespace signorini
