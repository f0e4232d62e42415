#pragma once
#include <array>
#include <functional>
#include <limits>
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

/// One cycle, or one step of another method. Everything is recomputed from the iterate, nothing is carried along.
struct IterationRecord {
  int iteration;                    ///< number of the step, from 1, over all stages that were kept
  double residual;                  ///< natural residual over its value at the projected zero
  double algebraic_error;           ///< estimate of ||x - x*||_A / ||x*||_A
  double energy;                    ///< 1/2 x'Ax - b'x, and what functionals add
  Index contact_nodes;              ///< vectors with a direction in contact
  Index changed;                    ///< vectors whose phase changed since the last cycle, on the finest level
  std::vector<LevelReport> levels;  ///< coarsest first; sums over the visits of the cycle, contact of the last one
  std::size_t stage = 0;            ///< in Summary::stages
};

/// Called after every step; returning false interrupts the solve, which then ends with Outcome::interrupted.
using Monitor = std::function<bool(const IterationRecord&)>;

enum class Outcome {
  converged,
  rounding,    ///< as far as the machine's precision allows, which is not to the tolerance (docs/solver.md)
  inaccurate,  ///< rounding leaves so large an error that nothing is claimed
  iteration_limit,
  interrupted,
  unbounded,
  stuck,  ///< the method cannot go on
  failed  ///< a method of which a part is missing, or that was out of memory
};

/// As reports name it: "solved", "limited by rounding"...
const char* outcome_name(Outcome outcome);

/// What one method did.
struct Stage {
  std::string method;
  std::string linear;                         ///< the linear solver, of methods that need one
  int iterations = 0;                         ///< that count in Summary::iterations
  int linear_solves = 0, factorisations = 0;  ///< on the finest level; set-ups of preconditioners are factorisations
  double seconds = 0;
  Outcome outcome = Outcome::failed;
  std::string reason;
  bool kept = true;  ///< false: the next stage started where this one had
};

inline constexpr double unknown_rate = std::numeric_limits<double>::quiet_NaN();

/// What a solve did, and in `reason` why it stopped: a sentence with the value and the threshold it met.
struct Summary {
  Outcome outcome = Outcome::iteration_limit;
  std::string reason;
  int iterations = 0;  ///< cycles on the finest level; where method "pdas" was asked for its steps
  double residual = 0, algebraic_error = 0, energy = 0;
  double rounding_error = 0;   ///< part of algebraic_error that no iteration removes; 0: far below the tolerance
  double rate = unknown_rate;  ///< mean reduction of the correction's energy norm over the last cycles, if known
  int linear_phase_from = 0;   ///< first cycle from which no phase changed, 0 if there was none
  std::vector<Stage> stages;   ///< in the order in which they ran
  std::vector<IterationRecord> history;  ///< of all steps of the stages that were kept
  std::vector<Index> level_unknowns;     ///< free unknowns, coarsest level first
  int finest_level = 0;                  ///< its number: 0 is the coarsest mesh, or a matrix without any mesh
  SolverOptions options;                 ///< with the method that "auto" stood for
  double setup_seconds = 0, solve_seconds = 0;

  /// The number of level k, from the coarsest: negative below the coarsest mesh, or below the matrix that was given.
  int level_number(std::size_t k) const {
    return finest_level + 1 + static_cast<int>(k) - static_cast<int>(level_unknowns.size());
  }

  /// Solved, to the tolerance or as far as the machine's precision allows.
  bool converged() const { return outcome == Outcome::converged || outcome == Outcome::rounding; }

  /// Goes on with what the next stages did from where this ended. The levels stay: in the records of methods with fewer
  /// ones the coarser are idle.
  void append(Summary next);
  /// A further part of the error by rounding, relative like `rounding_error`.
  void add_rounding(double error, double tolerance);
  /// Stages that came before, all of them dropped.
  void put_in_front(std::vector<Stage> dropped);
  /// Sets linear_phase_from by the history.
  void find_linear_phase();
};

}  // namespace signorini
