// The hierarchy of a linear multigrid code as a solver for an obstacle problem,
//
//     min 1/2 x'Ax - b'x   over x >= lower,
//
// all of it from Matrix Market files:
//
//     signorini_given_hierarchy A.mtx b.mtx lower.mtx P1.mtx P2.mtx ...
//
// P1 interpolates to the rows of A, P2 to the columns of P1 and so on: the finest comes first. The solution goes to
// standard output, also as a Matrix Market file, and what was found out about it to standard error.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "amg/black_box.hpp"
#include "core/io/matrix_market.hpp"

using signorini::BlackBox;
using signorini::SparseRows;

namespace {

/// How far x is from the solution, in its own unit: the largest Gauss-Seidel step that one unknown would still take.
/// Zero at the solution only, and computed without any part of the solver.
double largest_step(const SparseRows& A, const std::vector<double>& b, const std::vector<double>& lower,
                    const std::vector<double>& x) {
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double residual = b[i], diagonal = 0;
    for (auto k = A.row[i]; k < A.row[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(A.column[k]);
      residual -= A.value[k] * x[j];
      if (j == i) diagonal = A.value[k];
    }
    largest = std::max(largest, std::abs(std::max(residual / diagonal, lower[i] - x[i])));
  }
  return largest;
}

int solve(int argc, char** argv) {
  const SparseRows A = signorini::read_matrix(argv[1]);
  const auto b = signorini::read_vector(argv[2], A.rows, signorini::Infinities::refused);
  const auto lower = signorini::read_vector(argv[3], A.rows, signorini::Infinities::allowed);
  std::vector<SparseRows> interpolations;  // the solver takes the coarsest first
  for (int k = argc; k-- > 4;) interpolations.push_back(signorini::read_matrix(argv[k]));

  BlackBox solver(A, interpolations);  // serves any number of loads and bounds
  const BlackBox::Result result = solver.solve(b, lower);
  std::fputs(signorini::matrix_market(result.x).c_str(), stdout);

  int touching = 0;
  for (std::size_t i = 0; i < b.size(); ++i) touching += result.x[i] == lower[i];
  std::fprintf(stderr, "%s\n%d cycles on %zu levels, %d of %d unknowns at the bound, largest step left %.1e\n",
               result.summary.reason.c_str(), result.summary.iterations, result.summary.level_unknowns.size(), touching,
               A.rows, largest_step(A, b, lower, result.x));
  return result.summary.converged() ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr, "usage: %s A.mtx b.mtx lower.mtx P1.mtx [P2.mtx ...] > x.mtx\n", argv[0]);
    return 1;
  }
  try {
    return solve(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
