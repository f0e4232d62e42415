#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/bench/matrices/matrices.hpp"

namespace signorini::bench {

/// One level of nested meshes in matrices, in global coordinates and without prescribed vectors.
struct GridLevel {
  MatrixProblem problem;            ///< the columns of a row ascend
  SparseRows interpolation;         ///< from the unknowns of the next coarser level; none on the coarsest
  std::vector<double> offset;       ///< what prescribed values add to an interpolation
  std::vector<Index> twin;          ///< per unknown of the next coarser level, the same one here
  std::vector<double> coordinates;  ///< three per vector
};

/// What the solvers of a table are given.
struct Instance {
  int block = 1;
  std::vector<GridLevel> levels;  ///< coarsest first
  std::vector<double> free_load;  ///< right-hand side of the problem without bounds, on the finest level

  const MatrixProblem& finest() const { return levels.back().problem; }
};

/// What a solver found, and the seconds it took from the matrices on.
struct Attempt {
  double seconds = 0;
  int iterations = 0;
  std::vector<double> x;
};

/// Solves to a tolerance of the solver's own kind. Throws where it fails.
using Solver = std::function<Attempt(double tolerance)>;

/// The yardstick of one table: a solution to rounding and its energy norm, prescribed values counted in.
struct Reference {
  std::vector<double> x;
  double norm = 1;
};

/// A benchmark problem with this project's own solvers, which know its meshes.
struct Benchmark {
  Instance instance;
  double assembly = 0;           ///< seconds that all levels take to assemble; part of no solver's time
  Solver nested;                 ///< the default geometric solve
  Solver multigrid_cg;           ///< linear, without the obstacle
  Reference bounded, unbounded;  ///< solutions with and without the obstacle
};

/// @param name S2, S3, E3 or E3w, see benchmark_problem()
Benchmark make_benchmark(const std::string& name, int nodes);

/// Solvers that are given the matrix and the bounds alone: the black box, and without bounds conjugate gradients
/// preconditioned by a cycle on algebraic levels.
Solver black_box(const Instance& instance);
Solver algebraic_cg(const Instance& instance);

}  // namespace signorini::bench
