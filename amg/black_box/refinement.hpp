#pragma once
#include <span>
#include <vector>

#include "amg/black_box/held_rows.hpp"
#include "amg/black_box/motions.hpp"
#include "core/solver/summary.hpp"

namespace signorini {

/// Measures the error of what a solve ended with, and goes on where that is above the tolerance: active sets with a
/// factorisation of the free components and residuals in extended precision (Higham, Accuracy and Stability of
/// Numerical Algorithms, SIAM 2002, ch. 12), which rounding misleads only where the condition is beyond 1e15 or so.
/// Only where that is cheap beside the solve, or where rounding is in question and it is affordable.
/// @param held the rows of the components that the problem prescribes
/// @param b the forces of all components
/// @param motions of the matrix. Unless it is regular, one that rounding gives a little energy is not followed
/// @param x admissible
/// @param summary of the solve: a stage is added where x changes; its error is measured, if that could be done
template <int B>
void refine(const DiscreteProblem<B>& problem, const HeldRows<B>& held, std::span<const double> b,
            const SolverOptions& options, const Motions<B>& motions, std::vector<double>& x, Summary& summary);

}  // namespace signorini
