#pragma once
#include <limits>
#include <string>
#include <vector>

#include "core/base/types.hpp"

/// What may be attempted at a problem, in which order: the stages of method "auto", and what those who call it attempt
/// before and after. The lists are in stages.cpp, attempts.hpp runs them, and docs/theory/auto.md shows them.
namespace signorini::automatic {

/// When cycles are given up: after `first` of them, and later after every `every`, where their rate leads to more than
/// `most` in all.
struct Patience {
  int first, every, most;
};
inline constexpr Patience patience_with_cycles{60, 10, 200};
/// Where a load follows the solution: thin layers of rubber are slow, and are solved.
inline constexpr Patience patience_with_loads{120, 10, 200};
inline constexpr Patience endless{std::numeric_limits<int>::max(), 1, std::numeric_limits<int>::max()};
/// Where the coarsest level is left to sweeps.
inline constexpr Patience patience_with_sweeps{3, 1, 20};

/// What decides.
struct Situation {
  int block = 1;                            ///< unknowns per vector
  Index vectors = 0, coarsest_vectors = 0;  ///< on the finest and on the coarsest level, the same if there is one
  Offset couplings = 0;                     ///< of the vectors of the finest level
  Offset unknowns = 0, coarsest = 0;        ///< free unknowns there; before any stage: all of them
  bool levels = false;                      ///< there are several
  bool newton = false;                      ///< the coarse solver makes Newton steps, which may be dear
  bool begun = false;                       ///< a stage has been run
  bool functional = false;                  ///< an obstacle adds to the energy, or a load follows: no active sets
  bool friction = false;   ///< it is friction or such a load alone, with one direction of contact at each vertex
  bool following = false;  ///< a load follows the solution, as the pressure of rubber does
  bool slow = false;       ///< cycles came to the end of their patience
  bool spent = false;      ///< see DiscreteProblem
};

/// What makes the steps of a stage.
enum class Kind {
  cycles,
  cycles_again,
  cycles_from_zero,
  newton,
  single_level,
  active_sets,
  interior_points,
  nested_start,
  levels_of_matrix,
  levels_of_meshes,
  newton_by_meshes,
  pairs_anew,
  pairs_anew_first,
  sweeps_below,
  cycles_away,
  refinement
};

/// Where an attempt begins: where the last one that was kept ended, where the first one began, or at zero. From the
/// last two, what was kept before is dropped.
enum class Start { last, first, zero };

/// Whether what an attempt came to is kept: else the next one begins where this one did.
enum class Keep {
  always,
  solved,  ///< where the problem is, or the user ended it
  better,  ///< where it reaches the tolerance, or what was kept before does not count as solved
  never    ///< it is only looked at
};

inline constexpr int unlimited = std::numeric_limits<int>::max();

/// Attempts follow each other in the order of the list. Each begins where it suits and those before it have left the
/// problem unsolved.
struct Attempt {
  const char* name;
  Kind kind;
  const char* method;  ///< as reports name it; "auto": by what the cycles were
  const char* solver;  ///< registered: the coarse one, or the linear one; "": that of the options
  bool (*suits)(const Situation&) = nullptr;         ///< of stages; who attempts the others knows when
  std::string begins = {}, ends = {}, purpose = {};  ///< for the documentation
  int most_steps = unlimited;                        ///< fewer where `max_iterations` is reached
  Patience patience = patience_with_cycles;
  std::vector<Start> starts = {Start::last};  ///< each is an attempt
  Keep keep = Keep::always;
};

/// Those of method "auto".
const std::vector<Attempt>& stages();

/// Those around it, of one kind each: of scenes, and of a matrix and bounds alone.
const std::vector<Attempt>& attempts_around();
const Attempt& attempt(Kind kind);

/// Cycles with friction that levels by the matrix are given for stretched elastic cells. They may take sixty; without
/// friction they take twenty, or do not do.
inline constexpr int patience_with_friction = 100;
/// How often a load step is solved again because bodies have slid on in it.
inline constexpr int most_slides = 4;

/// Whether the factorisations of Newton's method with friction and pressures are affordable.
bool may_factorise_for_newton(int block, Offset unknowns);
/// Whether its steps are: without a load that follows, multigrid solves its systems as well.
bool newton_is_affordable(int block, Offset unknowns, bool levels, bool following);

/// Whether cycles that have begun need not go on to their end: some other method suits.
bool others_suit(const Situation& situation);

/// The registered linear solvers for active sets, those to be tried first in front; none: cycles have to do.
/// @param block unknowns per vector
/// @param unknowns, coarsest on the finest level and on the coarsest one
std::vector<std::string> solvers_for_active_sets(int block, Offset unknowns, Offset coarsest);

/// The lists as tables in Markdown.
std::string table_of_stages();
std::string table_of_attempts_around();

}  // namespace signorini::automatic
