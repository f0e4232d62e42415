#pragma once
#include "apps/bench/peers/petsc.hpp"

namespace signorini::bench {

/// What a solver is given, which says what it is compared with.
enum class Given { meshes, matrix };

/// BoomerAMG with the settings that did best for S2, S3 or elastic problems.
PetscPreconditioner boomeramg(const std::string& problem);

/// A row of the table.
struct Contestant {
  std::string name;
  Given given;
  bool bounded;  ///< false: the problem without bounds
  Solver solve;
};

/// All solvers for a problem; the first of those that are given the same, with the bounds, is this project's own.
std::vector<Contestant> contestants(const std::string& problem, const Benchmark& benchmark);

}  // namespace signorini::bench
