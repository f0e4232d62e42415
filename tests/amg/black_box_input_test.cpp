// What is wrong with a matrix, bounds or interpolations is said with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "amg/black_box.hpp"
#include "core/base/error.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using testing::ElementsAre;
using testing::HasSubstr;

template <class Action>
void expect_error(const Action& action, const std::string& message, Exit status = Exit::input) {
  try {
    action();
    ADD_FAILURE() << "accepted: " << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status);
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
}

void expect_refused(const Matrix& A, const std::string& message, int block = 1) {
  expect_error([&] { BlackBox(A, block); }, message);
}

TEST(BlackBoxMatrix, OfTheWrongShapeIsRefused) {
  expect_refused(Matrix(2, 3), "matrix: found 2 rows and 3 columns, expected a square matrix");
  expect_refused(Matrix(0, 0), "matrix: found no rows");
  expect_refused(laplacian(4), "matrix: found 9 rows, expected a multiple of the block size 2", 2);
  expect_refused(laplacian(4), "block: found 4, expected 1, 2 or 3 unknowns in a block", 4);
}

TEST(BlackBoxMatrix, WithBrokenRowsIsRefused) {
  const std::vector<double> value{1, 1};
  const auto refused = [&](std::vector<int> row, std::vector<int> column, const char* message) {
    expect_error([&] { BlackBox(SparseRows(2, 2, row.data(), column.data(), value.data())); }, message);
  };
  refused({0, 1, 2}, {0, 2}, "row 2 has an entry in column 3, expected 1 to 2");
  refused({0, 1, 2}, {-1, 1}, "row 1 has an entry in column 0, expected 1 to 2");
  refused({1, 1, 2}, {0, 1}, "the first row begins at entry 1, expected 0");
  refused({0, 2, 1}, {0, 1}, "row 2 ends at entry 1, before its begin 2");
  refused({0, -1, -2}, {0, 1}, "row 1 ends at entry -1, before its begin 0");
}

TEST(BlackBoxMatrix, WithArraysThatDoNotFitIsRefused) {
  const auto refused = [](auto&& change) {
    SparseRows A(laplacian(4));
    change(A);
    expect_error([&] { BlackBox solver(A); }, "matrix: found ");
  };
  refused([](SparseRows& A) { A.row.pop_back(); });
  refused([](SparseRows& A) { A.column.pop_back(); });
  refused([](SparseRows& A) { A.value.push_back(1); });
  refused([](SparseRows& A) { A.rows = -1; });
}

TEST(BlackBoxMatrix, WithValuesThatAreNotFiniteIsRefused) {
  for (const double bad : {std::nan(""), infinity}) {
    Matrix A = laplacian(4);
    A.coeffRef(3, 4) = bad;
    expect_refused(A, "matrix: the entry in row 4, column 5 is ");
  }
}

TEST(BlackBoxMatrix, ThatIsNotSymmetricIsRefusedButForRounding) {
  for (const int block : {1, 3}) {
    Matrix A = laplacian(4);
    A.coeffRef(3, 4) = -0.5;
    expect_refused(A, "not symmetric: the entry in row 4, column 5 is -0.5, the one in row 5, column 4 is -1", block);
    A = laplacian(4);
    A.coeffRef(0, 8) = 0.25;  // without counterpart in the pattern
    expect_refused(A, "not symmetric: the entry in row 1, column 9 is 0.25, the one in row 9, column 1 is 0", block);
    A = laplacian(4);
    A.coeffRef(0, 8) = 1e-14;
    A.coeffRef(3, 4) *= 1 + 1e-15;
    const std::vector<double> b(9, 1);
    EXPECT_TRUE(BlackBox(A, block).solve(b).summary.converged());
  }
}

TEST(BlackBoxMatrix, WithoutPositiveDiagonalIsRefused) {
  Matrix A = laplacian(4);
  A.coeffRef(4, 4) = 0;
  expect_refused(A, "the diagonal entry of row 5 is 0, expected a positive one: the matrix is not positive definite");
  A.coeffRef(4, 4) = -1;
  expect_refused(A, "the diagonal entry of row 5 is -1");
}

// Three rows are zero: loads go to their bounds, and what has none stays where it is.
TEST(BlackBoxMatrix, WithZeroRowsIsSolvedByBoundsAlone) {
  for (const int block : {1, 3}) {
    Matrix A = laplacian(7);
    std::vector<double> b(36, 1), lower(36, -2), upper(36, 0.5);
    A.prune([](int row, int column, double) { return row % 12 != 4 && column % 12 != 4; });
    b[4] = 2, b[16] = -2, b[28] = 0;
    BlackBox solver(A, block);
    const BlackBox::Result found = solver.solve(b, lower, upper);
    EXPECT_TRUE(found.summary.converged()) << found.summary.reason;
    EXPECT_EQ(found.x[4], 0.5);
    EXPECT_EQ(found.x[16], -2);
    EXPECT_EQ(found.x[28], 0);
    EXPECT_EQ(found.multiplier[4], -2);
    EXPECT_EQ(found.multiplier[16], 2);
    double energy = 0;
    for (int i = 0; i < 36; ++i) energy += 0.5 * found.x[i] * (found.multiplier[i] - b[i]);
    EXPECT_NEAR(found.summary.energy, energy, 1e-9 * std::abs(energy));
    const std::vector<double> start(36, 0.25);
    EXPECT_EQ(solver.solve(b, lower, upper, start).x[28], 0.25);
    upper[4] = std::numeric_limits<double>::infinity();
    try {
      solver.solve(b, lower, upper);
      FAIL() << "no bound holds the load in row 5";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::no_solution);
      EXPECT_THAT(error.what(), HasSubstr("row 5 of the matrix is zero"));
    }
  }
}

TEST(BlackBoxMatrix, OfZerosAloneIsSolvedByBoundsAlone) {
  const BlackBox::Result found =
      BlackBox(Matrix(3, 3))
          .solve(std::vector<double>{1, -1, 0}, std::vector<double>(3, -2), std::vector<double>(3, 4));
  EXPECT_TRUE(found.summary.converged()) << found.summary.reason;
  EXPECT_THAT(found.x, ElementsAre(4, -2, 0));
  EXPECT_NEAR(found.summary.energy, -6, 1e-12);
}

TEST(BlackBoxMatrix, WithTwoRowsThatAreIndefiniteIsRefused) {
  Matrix A = laplacian(4);
  A.coeffRef(3, 4) = A.coeffRef(4, 3) = 4.1;
  expect_refused(A, "not positive semidefinite: the entry 4.1 in row 4, column 5 is larger than the diagonal entries");
}

Matrix shifted(const Matrix& A, double shift) {
  Matrix I(A.rows(), A.cols());
  I.setIdentity();
  return A - shift * I;
}

double smallest_eigenvalue(int cells) { return 8 * std::pow(std::sin(std::numbers::pi / 2 / cells), 2); }

TEST(BlackBoxMatrix, ThatIsIndefiniteIsRefusedWhereverItShows) {
  for (const int cells : {10, 40, 160}) {
    const Matrix A = laplacian(cells);
    BlackBox accepted(shifted(A, 0.9 * smallest_eigenvalue(cells)));
    expect_refused(shifted(A, 1.2 * smallest_eigenvalue(cells)), "indefinite: d'Ad is -");  // smooth directions
    // Rough ones: the same with the signs of a checkerboard.
    Eigen::VectorXd sign(A.rows());
    for (Eigen::Index i = 0; i < sign.size(); ++i) sign[i] = (i / (cells - 1) + i % (cells - 1)) % 2 ? 1 : -1;
    expect_refused(sign.asDiagonal() * shifted(A, 0.4) * sign.asDiagonal(), "indefinite: d'Ad is -");
  }
}

// One node whose diagonal entry is too small for its neighbours, whichever two rows one looks at.
TEST(BlackBoxMatrix, ThatIsIndefiniteAtOneNodeIsRefusedWithItsRow) {
  for (const int cells : {10, 160}) {
    Matrix A = laplacian(cells);
    const Eigen::Index at = A.rows() / 2;
    A.coeffRef(at, at) = 0.9;
    expect_refused(A, "largest entry in row " + std::to_string(at + 1));
  }
}

TEST(BlackBoxMatrix, InBlocksThatIsIndefiniteIsRefused) {
  Random random(91);
  for (int trial = 0; trial < 10; ++trial) {
    const Matrix A = sparse(random_matrix<3>(random, 600));
    BlackBox accepted(A, 3);
    expect_refused(shifted(A, 0.2), "definite", 3);
  }
}

TEST(BlackBoxInput, OfTheWrongSizeOrNotFiniteIsRefused) {
  BlackBox solver(laplacian(4));
  const std::vector<double> good(9, 0), shorter(8, 0);
  const auto refused = [&](auto&& b, auto&& lower, auto&& upper, auto&& start, const char* message) {
    expect_error([&] { solver.solve(b, lower, upper, start); }, message);
  };
  refused(shorter, good, good, good, "b: found 8 values, expected 9, one per row of the matrix");
  refused(good, shorter, good, good, "lower: found 8 bounds, expected 9");
  refused(good, good, shorter, good, "upper: found 8 bounds, expected 9");
  refused(good, good, good, shorter, "start: found 8 values, expected 9");
  for (const double bad : {std::nan(""), infinity}) {
    std::vector<double> broken = good;
    broken[3] = bad;
    refused(broken, good, good, good, "b: found ");
    refused(good, good, good, broken, "start: found ");
  }
  std::vector<double> broken = good;
  broken[3] = std::nan("");
  refused(good, broken, good, good, "lower: found NaN in row 4, expected a number, inf or -inf");
  refused(good, good, broken, good, "upper: found NaN in row 4");
}

TEST(BlackBoxInput, BoundsWithNothingBetweenHaveNoSolution) {
  BlackBox solver(laplacian(4));
  const std::vector<double> zero(9, 0);
  std::vector<double> lower(9, -1), upper(9, 1);
  const auto infeasible = [&](const char* message) {
    expect_error([&] { solver.solve(zero, lower, upper); }, message, Exit::no_solution);
  };
  lower[2] = 2;
  infeasible("in 1 row: row 3: 2 and 1");
  lower[2] = infinity;
  upper[2] = infinity;
  infeasible("in 1 row: row 3: inf and inf");
  lower.assign(9, 3);
  infeasible("in 8 rows: row 1: 3 and 1, row 2: 3 and 1, row 4: 3 and 1");
}

TEST(BlackBoxLevels, ThatDoNotFitAreRefused) {
  const Matrix A = laplacian(4);
  const auto refused = [&](std::vector<SparseRows> levels, const char* message, int block = 1) {
    expect_error([&] { BlackBox(A, levels, block); }, message);
  };
  refused({Matrix(8, 3)}, "interpolation 1 of 1, coarsest first: found 8 rows, expected 9, the number of rows");
  refused({Matrix(2, 1), Matrix(9, 3)}, "interpolation 1 of 2, coarsest first: found 2 rows, expected 3");
  refused({Matrix(9, 3)}, "found 9 rows, expected 3, the number of rows of the matrix over the block size", 3);
  refused({Matrix(9, 0)}, "found no columns");
  Matrix P(9, 3);
  P.insert(4, 1) = std::nan("");
  refused({P}, "the entry in row 5, column 2 is nan");
}

TEST(BlackBoxMatrices, OfCoarseLevelsThatDoNotFitAreRefused) {
  const Matrix A = laplacian(4);
  Matrix P(9, 3);
  for (int i = 0; i < 9; ++i) P.insert(i, i / 3) = 1;
  const Matrix product = P.transpose() * A * P;
  const auto refused = [&](const std::vector<SparseRows>& matrices, const char* message) {
    expect_error([&] { BlackBox(A, std::vector<SparseRows>{P}, 1, {}, matrices); }, message);
  };
  refused({product, product}, "coarse matrices: found 2, expected 1, one for each interpolation");
  refused({A}, "coarse matrix 1 of 1, coarsest first: found 9 rows, expected 3, the number of columns");
  refused({Matrix(P.transpose())}, "coarse matrix 1 of 1, coarsest first: matrix: found 3 rows and 9 columns");
  Matrix other = product;
  other.coeffRef(0, 1) = -2;
  refused({other}, "coarse matrix 1 of 1, coarsest first: matrix: not symmetric");
  refused({Matrix(product * 1.001)}, "coarse matrix 1 of 1, coarsest first: is not the Galerkin product P'AP");
  other = product;
  other.coeffRef(0, 2) = other.coeffRef(2, 0) = 1e-13;  // rounding, but rows of the grid that are not neighbours
  refused({other}, "coarse matrix of 3 rows: rows 1 and 3 are coupled, but not in the Galerkin product");
}

TEST(BlackBoxOptions, AreThoseOfTheSolver) {
  const Matrix A = laplacian(4);
  const std::vector<double> b(9, 1);
  expect_error([&] { BlackBox(A, 1, {.tolerance = 0}).solve(b); }, "solver.tolerance");
  expect_error([&] { BlackBox(A, 1, {.method = "magic"}).solve(b); }, "solver.method");
  expect_error([&] { BlackBox(A, 1, {.smoother = "forwart"}); },
               "solver.smoother: there is no smoother 'forwart', did");
  expect_error([&] { BlackBox(A, 1, {.transfer = "min"}); }, "solver.transfer: there is no transfer 'min'");
  expect_error([&] { BlackBox(A, 1, {.coarse = "direct"}); }, "solver.coarse: there is no coarse 'direct'");
  expect_error([&] { BlackBox(A, 1, {.aggregates = "greddy"}); }, "solver.aggregates: there is no aggregates 'greddy'");
  expect_error([&] { BlackBox(A, std::vector<SparseRows>(), 1, {.smoother = "x"}); }, "solver.smoother");
  BlackBox solver(A, 1);
  expect_error([&] { solver.set_tolerance(2); }, "solver.tolerance");
  EXPECT_TRUE(solver.solve(b).summary.converged()) << "with the tolerance it had";
  EXPECT_EQ(BlackBox(laplacian(40), 1, {.max_iterations = 1}).solve(std::vector<double>(39 * 39, 1)).summary.outcome,
            Outcome::iteration_limit);
}

}  // namespace
}  // namespace signorini::test
