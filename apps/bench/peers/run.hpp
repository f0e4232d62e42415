#pragma once
#include "apps/bench/peers/accuracy.hpp"

namespace signorini::bench {

/// When a solver is given up, all its tolerances together, and how often a short one is repeated.
struct Patience {
  double seconds = 60;  ///< of processor time
  int repeats = 3;
  double is_short = 10;  ///< seconds
};

/// What came out of a solver.
struct Measurement {
  Attempt attempt;
  double tolerance = 0;  ///< that it was given in the end
  double error = 0, residual = 0;
  bool too_slow = false;
  std::string failure;  ///< empty: accurate enough

  bool solved() const { return failure.empty(); }
};

/// One run in a process of its own: what a library leaves behind, or its crash, concerns no other run. Its result has
/// `size` numbers; no accuracy is judged.
Measurement run_apart(const Solver& solver, std::size_t size, double tolerance, double limit);

/// The accuracy that counts: ||x - x*||_A / ||x*||_A and the natural residual.
inline constexpr double demanded_error = 1e-6, demanded_residual = 1e-8;

/// Runs a solver in processes of its own, from a tolerance of 1e-6 on with tighter and tighter ones until the result is
/// accurate enough. Only the last run counts; where it was short it is repeated and the best time taken.
Measurement measure(const Solver& solver, const QuadraticProgram& program, const Reference& reference,
                    const Patience& patience);

}  // namespace signorini::bench
