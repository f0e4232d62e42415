// An algebraic multigrid method of PETSc as a solver for an obstacle problem: a membrane whose stiffness jumps by four
// orders of magnitude, pulled onto a floor,
//
//     min 1/2 a(u, u) - f(u)   over u >= floor,   a(u, v) = integral of k grad u . grad v,
//
// with finite volumes on the unit square. PETSc sets up its levels for the matrix alone, as for a linear system. Their
// interpolations and matrices are what the nonlinear solver takes; its solution is compared with that on levels of its
// own.
//
//     signorini_petsc_hierarchy [NODES [FOLDER]] [PETSc's options]
//
// NODES (default 256) are those of a side; matrix, load, bounds and interpolations are written to FOLDER, for
// signorini_given_hierarchy. The levels are GAMG's; `-pc_type hypre` takes those of BoomerAMG, `-pc_type ml` those of
// ML.
#include <fmt/format.h>
#include <petsc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "amg/black_box.hpp"
#include "core/base/error.hpp"
#include "core/io/matrix_market.hpp"

using signorini::BlackBox;
using signorini::SparseRows;

namespace {

void check(PetscErrorCode status) { PetscCallAbort(PETSC_COMM_SELF, status); }

/// Patches of a sixth of the side, each with one of five stiffnesses from 0.01 to 100.
double stiffness(double x, double y) {
  const int patch = static_cast<int>(6 * x) * 7 + static_cast<int>(6 * y) * 11;
  return std::pow(10, patch % 5 - 2);
}

/// Fluxes between the nodes of a grid and to the boundary, where the membrane is held.
Mat membrane(int nodes) {
  Mat A = nullptr;
  check(MatCreateSeqAIJ(PETSC_COMM_SELF, nodes * nodes, nodes * nodes, 5, nullptr, &A));
  const double h = 1.0 / (nodes + 1);
  for (int j = 0; j < nodes; ++j)
    for (int i = 0; i < nodes; ++i) {
      const int here = j * nodes + i;
      for (const auto& [di, dj] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const double k = stiffness((i + 1 + 0.5 * di) * h, (j + 1 + 0.5 * dj) * h);
        const int x = i + di, y = j + dj;
        check(MatSetValue(A, here, here, k, ADD_VALUES));
        if (std::min(x, y) >= 0 && std::max(x, y) < nodes) check(MatSetValue(A, here, y * nodes + x, -k, ADD_VALUES));
      }
    }
  check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  return A;
}

/// A copy of a matrix of PETSc.
SparseRows rows_of(Mat A) {
  static_assert(sizeof(PetscInt) == sizeof(signorini::Index), "PETSc with indices of 32 bits");
  PetscInt rows = 0, columns = 0;
  const PetscInt *row = nullptr, *column = nullptr;
  const double* value = nullptr;
  PetscBool done = PETSC_FALSE;
  check(MatGetSize(A, nullptr, &columns));
  check(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row, &column, &done));
  check(MatSeqAIJGetArrayRead(A, &value));
  SparseRows copy(rows, columns, row, column, value);
  check(MatSeqAIJRestoreArrayRead(A, &value));
  check(MatRestoreRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row, &column, &done));
  return copy;
}

/// Copies, and frees the matrices.
std::vector<SparseRows> rows_of(PetscInt count, Mat* matrices) {
  std::vector<SparseRows> copies;
  for (PetscInt k = 0; k < count; ++k) {
    copies.push_back(rows_of(matrices[k]));
    check(MatDestroy(&matrices[k]));
  }
  check(PetscFree(matrices));
  return copies;
}

/// What a linear multigrid code has made.
struct Hierarchy {
  std::string code;
  int iterations = 0;                                ///< of conjugate gradients with it, for a constant load
  std::vector<SparseRows> interpolations, matrices;  ///< coarsest first
};

Hierarchy linear_multigrid(Mat A) {
  KSP solver = nullptr;
  PC preconditioner = nullptr;
  check(KSPCreate(PETSC_COMM_SELF, &solver));
  check(KSPSetType(solver, KSPCG));
  check(KSPSetTolerances(solver, 1e-8, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  check(KSPGetPC(solver, &preconditioner));
  check(PCSetType(preconditioner, PCGAMG));
  check(KSPSetFromOptions(solver));
  check(MatSetOption(A, MAT_SPD, PETSC_TRUE));
  check(KSPSetOperators(solver, A, A));
  Vec x = nullptr, b = nullptr;
  check(MatCreateVecs(A, &x, &b));
  check(VecSet(b, 1));
  check(KSPSolve(solver, b, x));

  PCType code = nullptr;
  PetscInt iterations = 0, levels = 0;
  Mat *interpolations = nullptr, *matrices = nullptr;
  check(PCGetType(preconditioner, &code));
  check(KSPGetIterationNumber(solver, &iterations));
  check(PCGetInterpolations(preconditioner, &levels, &interpolations));
  check(PCGetCoarseOperators(preconditioner, &levels, &matrices));
  Hierarchy out{code, static_cast<int>(iterations), rows_of(levels - 1, interpolations), rows_of(levels - 1, matrices)};
  check(VecDestroy(&x));
  check(VecDestroy(&b));
  check(KSPDestroy(&solver));
  return out;
}

void write(const std::filesystem::path& folder, const SparseRows& A, const std::vector<double>& b,
           const std::vector<double>& lower, const Hierarchy& levels) {
  const auto put = [&](const std::string& name, const std::string& text) { std::ofstream(folder / name) << text; };
  std::filesystem::create_directories(folder);
  put("A.mtx", signorini::matrix_market(A));
  put("b.mtx", signorini::matrix_market(b));
  put("lower.mtx", signorini::matrix_market(lower));
  const std::size_t count = levels.interpolations.size();
  for (std::size_t k = 0; k < count; ++k)
    put(fmt::format("P{}.mtx", count - k), signorini::matrix_market(levels.interpolations[k]));
}

int solve(int nodes, const char* folder) {
  Mat matrix = membrane(nodes);
  const Hierarchy levels = linear_multigrid(matrix);
  const SparseRows A = rows_of(matrix);
  check(MatDestroy(&matrix));

  const double h = 1.0 / (nodes + 1);
  const std::vector<double> b(static_cast<std::size_t>(A.rows), -h * h), lower(b.size(), -0.01);
  if (folder) write(folder, A, b, lower, levels);
  const auto result = BlackBox(A, levels.interpolations, 1, {}, levels.matrices).solve(b, lower);
  const auto own = BlackBox(A).solve(b, lower);

  double difference = 0;
  for (std::size_t i = 0; i < b.size(); ++i) difference = std::max(difference, std::abs(result.x[i] - own.x[i]));
  fmt::print("{} unknowns, {} on the floor\n", A.rows, std::ranges::count(result.x, lower[0]));
  fmt::print("without floor: {} iterations of CG with {}\n", levels.iterations, levels.code);
  for (const auto& [name, summary] : {std::pair(levels.code, result.summary), {"the solver's own", own.summary}})
    fmt::print("with floor: {} cycles on {} levels, {}\n", summary.iterations, summary.level_unknowns.size(), name);
  fmt::print("largest difference of the solutions {:.1e}, of {}\n", difference, -lower[0]);
  return result.summary.converged() && own.summary.converged() && difference <= -1e-6 * lower[0] ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
  check(PetscInitialize(&argc, &argv, nullptr, nullptr));
  const int nodes = argc > 1 && argv[1][0] != '-' ? std::atoi(argv[1]) : 256;
  const char* folder = argc > 2 && argv[1][0] != '-' && argv[2][0] != '-' ? argv[2] : nullptr;
  int status = 2;
  try {
    if (nodes < 3 || nodes > 4000) signorini::input_error("NODES", "expected a number from 3 to 4000");
    status = solve(nodes, folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  check(PetscFinalize());
  return status;
}
