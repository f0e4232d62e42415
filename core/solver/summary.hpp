#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/solver/options.hpp"

namespace signorini {

/// What one cycle did on a level.
struct LevelReport {
  Index vectors = 0;                  ///< of the level
  Index critical = 0;                 ///< vectors with a direction in contact
  std::array<Index, 3> contact = {};  ///< directions in contact, by their number in local coordinates
  Index changed = 0;                  ///< vectors whose phase changed since the last visit
  Index renewed = 0;                  ///< matrix rows recomputed
  double seconds = 0;                 ///< without the coarser levels
};

/// One cycle. Everything is recomputed from the iterate, nothing is carried along.
struct IterationRecord {
  int iteration;
  double residual;                  ///< natural residual over its value at the projected zero
  double algebraic_error;           ///< estimate of ||x - x*||_A / ||x*||_A
  double energy;                    ///< 1/2 x'Ax - b'x
  Index contact_nodes;              ///< vectors with a direction in contact
  Index changed;                    ///< vectors whose phase changed since the last cycle, on the finest level
  std::vector<LevelReport> levels;  ///< coarsest first; sums over the visits of the cycle, contact of the last one
};

enum class Outcome {
  converged,
  rounding,
  iteration_limit,
  interrupted,
  unbounded,
  stuck,    ///< the method cannot go on
  violated  ///< the problem is solved, but an obstacle that is not part of it does not hold
};

/// What a solve did, and in `reason` why it stopped: a sentence with the value and the threshold it met.
struct Summary {
  Outcome outcome = Outcome::iteration_limit;
  std::string reason;
  int iterations = 0;
  double residual = 0, algebraic_error = 0, energy = 0;
  double rate = 0;            ///< mean reduction of the correction's energy norm over the last cycles
  int linear_phase_from = 0;  ///< first cycle from which no phase changed, 0 if there was none
  std::vector<IterationRecord> history;
  std::vector<Index> level_unknowns;  ///< free unknowns, coarsest level first
  int finest_level = 0;               ///< its number: 0 is the coarsest mesh, or a matrix without any mesh
  SolverOptions options;              ///< with the method that "auto" stood for
  double setup_seconds = 0, solve_seconds = 0;

  /// The number of level k, from the coarsest: negative below the coarsest mesh, or below the matrix that was given.
  int level_number(std::size_t k) const {
    return finest_level + 1 + static_cast<int>(k) - static_cast<int>(level_unknowns.size());
  }

  /// Solved as far as the machine's precision allows.
  bool converged() const { return outcome == Outcome::converged || outcome == Outcome::rounding; }
};

}  // namespace signorini
