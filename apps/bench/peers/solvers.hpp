#pragma once
#include "apps/bench/peers/instance.hpp"

namespace signorini::bench {

/// What a solver is given, which says what it is compared with.
enum class Given { meshes, matrix };

/// A row of the table.
struct Contestant {
  std::string name;
  Given given;
  bool bounded;            ///< false: the problem without bounds
  double first_tolerance;  ///< of the solver's own kind
  Solver solve;
};

/// All solvers for a problem; the first of those that are given the same, with the bounds, is this project's own.
std::vector<Contestant> contestants(const std::string& problem, const Benchmark& benchmark);

}  // namespace signorini::bench
