#pragma once
#include <string>

namespace signorini {

/// Options of the solver; names, defaults and meaning as the keys of `[solver]`.
struct SolverOptions {
  double tolerance = 1e-8;  ///< for the relative algebraic error and for the natural residual
  int max_iterations = 200;
  std::string method = "auto";         ///< auto, monotone, tnnmg, pgs, pdas or newton
  std::string cycle = "V";             ///< V, W or F
  int pre = 2, post = 2;               ///< smoothing steps before and after the coarse correction
  std::string smoother = "forward";    ///< a registered smoother
  double relaxation = 1.2;             ///< of the smoother's sweeps, in (0, 2); 1 is plain Gauss-Seidel
  std::string transfer = "min_merge";  ///< a registered monotone restriction
  std::string coarse = "newton";       ///< a registered coarse solver
  std::string truncate = "normal";     ///< none, normal or tangential
  std::string coarsening = "auto";     ///< of algebraic levels: auto, classical or aggregation
  std::string aggregates = "greedy";   ///< of levels by aggregation: a registered kind
  double cut = 0;              ///< truncate also at distances up to this part of the last cycle's largest change
  std::string rotate = "all";  ///< all, not_coarsest, meshes or none
  bool reassemble = true;      ///< renew the matrices of algebraic levels where phases have changed
  std::string reach = "all";   ///< all or twins: what corrects constrained vectors from algebraic levels
  std::string interpolate = "global";  ///< global or local: components between algebraic levels
  bool krylov = true;                  ///< accelerate the cycles while the phases rest
  int threads = 1;                     ///< at most; small problems start none, and results do not depend on them
};

}  // namespace signorini
