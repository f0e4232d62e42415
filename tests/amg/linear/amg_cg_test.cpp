// Conjugate gradients with an algebraic cycle, as active sets use them.
#include "amg/linear/amg_cg.hpp"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include "amg/registration.hpp"
#include "tests/amg/matrices.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// What a linear solver gets of a matrix: its scaled lower triangle.
struct Scaled {
  std::vector<Offset> start{0};
  std::vector<Index> row;
  std::vector<double> value, scale;

  explicit Scaled(const Matrix& A) {
    for (Eigen::Index k = 0; k < A.cols(); ++k) scale.push_back(1 / std::sqrt(A.coeff(k, k)));
    for (Eigen::Index k = 0; k < A.cols(); ++k) {
      for (Matrix::InnerIterator entry(A, k); entry; ++entry) {
        const auto i = static_cast<Index>(entry.row());
        if (i < k) continue;
        row.push_back(i);
        value.push_back(i == k ? 1 : entry.value() * scale[i] * scale[static_cast<std::size_t>(k)]);
      }
      start.push_back(static_cast<Offset>(row.size()));
    }
  }

  /// S b, then S times the solution of (SAS) y = S b.
  bool solve(std::vector<double>& x) const {
    AmgConjugateGradients solver(solver_components);
    solver.analyse(start, row);
    const auto apply_scale = [&] {
      for (std::size_t i = 0; i < x.size(); ++i) x[i] *= scale[i];
    };
    apply_scale();
    const bool solved = solver.factorise(value, scale) && solver.solve(x);
    apply_scale();
    return solved;
  }
};

/// Every row's unit is a thousand times that of the row before, in turns of four; some rows are held.
Matrix in_many_units(const Matrix& given) {
  Eigen::VectorXd unit(given.rows());
  for (Eigen::Index i = 0; i < unit.size(); ++i) unit[i] = std::pow(1000.0, static_cast<double>(i % 4));
  Matrix A = unit.asDiagonal() * given * unit.asDiagonal();
  A.prune([](Eigen::Index i, Eigen::Index j, double) { return i == j || (i % 7 != 3 && j % 7 != 3); });
  return A;
}

TEST(AmgConjugateGradients, SolveInAnyUnitsWithRowsHeld) {
  for (const Matrix& A : {laplacian(60), in_many_units(laplacian(60))}) {
    std::vector<double> x = waves(static_cast<std::size_t>(A.rows()));
    const Eigen::VectorXd exact = Eigen::SimplicialLDLT<Matrix>(A).solve(vector(x));
    ASSERT_TRUE(Scaled(A).solve(x));
    const Eigen::VectorXd error = vector(x) - exact;
    EXPECT_LE(error.dot(A * error), 1e-12 * exact.dot(A * exact));
  }
}

TEST(AmgConjugateGradients, SayWhereThereIsNoSolution) {
  const Matrix A = neumann_laplacian(40);
  std::vector<double> x(static_cast<std::size_t>(A.rows()), 1);
  EXPECT_FALSE(Scaled(A).solve(x));
}

}  // namespace
}  // namespace signorini::test
