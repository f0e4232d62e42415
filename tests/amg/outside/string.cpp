// A string that a load presses onto a floor which sinks: solved with the matrix and the interpolations of a linear
// multigrid code, here linear finite elements on nested grids.
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdio>
#include <vector>

#include <signorini/matrix/black_box.hpp>

using Matrix = Eigen::SparseMatrix<double>;

/// -u'' on the n inner nodes of a grid on (0, 1).
Matrix stiffness(int n) {
  Matrix A(n, n);
  A.reserve(Eigen::VectorXi::Constant(n, 3));  // else every insertion moves what is there
  for (int i = 0; i < n; ++i) {
    A.insert(i, i) = 2.0 * (n + 1);
    if (i > 0) A.insert(i, i - 1) = A.insert(i - 1, i) = -1.0 * (n + 1);
  }
  return A;
}

/// To the n inner nodes of a grid from those of the grid with half as many cells.
Matrix interpolation(int n) {
  Matrix P(n, n / 2);
  for (int i = 0; i < n / 2; ++i) {
    P.insert(2 * i, i) = P.insert(2 * i + 2, i) = 0.5;
    P.insert(2 * i + 1, i) = 1;
  }
  return P;
}

int main() {
  const int n = (1 << 14) - 1;
  std::vector<signorini::SparseRows> interpolations;  // the coarsest first
  for (int fine = 15; fine <= n; fine = 2 * fine + 1) interpolations.emplace_back(interpolation(fine));
  signorini::BlackBox solver(stiffness(n), interpolations);

  const std::vector<double> load(n, -1.0 / (n + 1));
  std::vector<double> x;
  for (const double floor : {-0.03, -0.06, -0.12}) {
    const std::vector<double> lower(n, floor);
    const auto result = solver.solve(load, lower, {}, x);  // from the last solution
    if (!result.summary.converged()) return 1;
    x = result.x;
    std::printf("floor %g: %d of %d nodes on it, %d cycles on %zu levels\n", floor,
                static_cast<int>(std::count(x.begin(), x.end(), floor)), n, result.summary.iterations,
                result.summary.level_unknowns.size());
  }
}
