// Matrices with a negative eigenvalue are refused however small it is; semidefinite ones, as rounding leaves them,
// pass.
#include "amg/black_box/refuse_indefinite.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <numbers>

#include "amg/black_box.hpp"
#include "amg/black_box/block_rows.hpp"
#include "amg/black_box/motions.hpp"
#include "core/base/error.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/nightly.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using ::testing::HasSubstr;

/// What the set-up says; empty: the matrix is accepted.
std::string refusal(const Matrix& A, int block = 1) {
  try {
    BlackBox solver(A, block);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input) << error.what();
    return error.what();
  }
}

Matrix shifted(const Matrix& A, double shift) {
  Matrix I(A.rows(), A.cols());
  I.setIdentity();
  return A - shift * I;
}

/// By inverse iteration with a direct solver.
double smallest_eigenvalue(const Matrix& A) {
  const Eigen::SimplicialLLT<Matrix> factor(A);
  Eigen::VectorXd v(A.rows());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = 1 + std::sin(static_cast<double>(i));
  for (int step = 0; step < 100; ++step) v = factor.solve(v.normalized());
  return v.dot(A * v) / v.squaredNorm();
}

Matrix string_of(Index n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2);
    if (i == 0) continue;
    entries.emplace_back(i, i - 1, -1);
    entries.emplace_back(i - 1, i, -1);
  }
  Matrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

double smallest_eigenvalue_of_string(Index n) {
  return 4 * std::pow(std::sin(std::numbers::pi / 2 / static_cast<double>(n + 1)), 2);
}

Matrix with_random_signs(Random& random, const Matrix& A) {
  Eigen::VectorXd s(A.rows());
  for (double& value : s) value = random.chance(0.5) ? 1 : -1;
  return s.asDiagonal() * A * s.asDiagonal();
}

Matrix with_random_signs_and_units(Random& random, const Matrix& A) {
  Eigen::VectorXd s(A.rows());
  for (double& value : s) value = std::ldexp(random.chance(0.5) ? 1 : -1, random.below(9) - 4);
  return s.asDiagonal() * A * s.asDiagonal();
}

TEST(Definite, ShiftedStrings) {
  Random random(101);
  for (const Index n : {5, 20, 60, 300, 1000, 20000})
    for (const double times : {1.01, 1.05, 1.2, 1.5}) {
      SCOPED_TRACE(fmt::format("{} rows, {}", n, times));
      const double eigenvalue = smallest_eigenvalue_of_string(n);
      EXPECT_THAT(refusal(shifted(string_of(n), times * eigenvalue)), HasSubstr("indefinite: d'Ad is -"));
      EXPECT_THAT(refusal(with_random_signs_and_units(random, shifted(string_of(n), times * eigenvalue))),
                  HasSubstr("indefinite: d'Ad is -"));
      EXPECT_EQ(refusal(shifted(string_of(n), 0.99 / times * eigenvalue)), "");
    }
}

// Most are too large to be factorised: smooth directions are looked for level by level.
TEST(Definite, ShiftedMembranesAndBodies) {
  for (const int cells : {100, nightly(250, 160)}) {
    const Matrix A = laplacian(cells);
    const double eigenvalue = 8 * std::pow(std::sin(std::numbers::pi / 2 / cells), 2);
    for (const double times : {1.01, 1.05, 1.5})
      EXPECT_THAT(refusal(shifted(A, times * eigenvalue)), HasSubstr("indefinite: d'Ad is -"))
          << cells << ", " << times;
    EXPECT_EQ(refusal(shifted(A, 0.99 * eigenvalue)), "") << cells;
  }
  Model<2> model;
  model.fixes = {{on("bottom"), {Field(0), Field(0)}}};
  const Matrix A = sparse(discretize<2, 2>(cube<2>(0, 1, 120), model).problem.A);
  const double eigenvalue = smallest_eigenvalue(A);
  for (const double times : {1.05, 1.2, 1.5})
    EXPECT_THAT(refusal(shifted(A, times * eigenvalue), 2), HasSubstr("indefinite: d'Ad is -")) << times;
  EXPECT_EQ(refusal(shifted(A, 0.99 * eigenvalue), 2), "");
}

// What is smooth then changes its sign from one unknown to the next, and no level represents it.
TEST(Definite, ShiftedMembranesWithRandomSigns) {
  Random random(104);
  const auto check = [&](int cells, std::initializer_list<double> shifts) {
    const double eigenvalue = 8 * std::pow(std::sin(std::numbers::pi / 2 / cells), 2);
    for (const double times : shifts)
      EXPECT_THAT(refusal(with_random_signs(random, shifted(laplacian(cells), times * eigenvalue))),
                  HasSubstr("indefinite: d'Ad is -"))
          << cells << ", " << times;
    EXPECT_EQ(refusal(with_random_signs(random, shifted(laplacian(cells), 0.99 * eigenvalue))), "") << cells;
  };
  check(81, {1.01, 1.05, 1.5, 2, 5, 20});
  check(201, {5});
}

// Levels that see one unknown per row represent few of the smooth directions.
TEST(Definite, ShiftedBodiesWithoutBlocks) {
  Model<2> model;
  model.fixes = {{on("bottom"), {Field(0), Field(0)}}};
  const Matrix A = sparse(discretize<2, 2>(cube<2>(0, 1, 60), model).problem.A);
  const double eigenvalue = smallest_eigenvalue(A);
  for (const double times : {1.01, 1.2, 5.0})
    EXPECT_THAT(refusal(shifted(A, times * eigenvalue)), HasSubstr("indefinite: d'Ad is -")) << times;
  EXPECT_EQ(refusal(shifted(A, 0.99 * eigenvalue)), "");
}

// Q'DQ with random rotations.
TEST(Definite, DenseMatricesWithOneNegativeEigenvalue) {
  Random random(102);
  for (int trial = 0; trial < 60; ++trial) {
    const Eigen::Index n = 3 + random.below(trial % 10 == 0 ? 300 : 60);
    Eigen::MatrixXd random_matrix(n, n);
    for (double& value : random_matrix.reshaped()) value = random.between(-1, 1);
    const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(random_matrix).householderQ();
    Eigen::VectorXd eigenvalues(n);
    for (double& value : eigenvalues) value = std::pow(10, random.between(trial % 2 ? -6 : 0, 1));
    const auto with_first = [&](double value) {
      eigenvalues[0] = value;
      const Eigen::MatrixXd A = Q.transpose() * eigenvalues.asDiagonal() * Q;
      return Matrix((0.5 * (A + A.transpose())).sparseView());
    };
    const double size = std::pow(10, random.between(-8, 0));
    EXPECT_NE(refusal(with_first(-size)), "") << trial << ": " << size;
    EXPECT_EQ(refusal(with_first(size)), "") << trial << ": " << size;
    EXPECT_EQ(refusal(with_first(0)), "") << trial;
  }
}

// Normal equations, Gram matrices, floating bodies: their smallest eigenvalues are zero but for rounding of either
// sign.
TEST(Definite, RoundingIsNotRefused) {
  Random random(103);
  for (int trial = 0; trial < 60; ++trial) {
    const Index n = 10 + random.below(trial % 10 == 0 ? 1500 : 150), equations = 1 + random.below(n);
    std::vector<Eigen::Triplet<double>> entries;
    const double decades = trial % 3;
    for (Index i = 0; i < n; ++i)
      for (int k = 0; k < 4; ++k)
        entries.emplace_back(random.below(equations), i, std::pow(10, random.between(-decades, decades)) - 1);
    Matrix G(equations, n);
    G.setFromTriplets(entries.begin(), entries.end());
    EXPECT_EQ(refusal(G.transpose() * G), "") << trial;
  }
  for (const int rank : {1, 5, 40}) {
    Eigen::MatrixXd X(300, rank);
    for (double& value : X.reshaped()) value = random.between(-1, 1);
    EXPECT_EQ(refusal(Eigen::MatrixXd(X * X.transpose()).sparseView()), "") << rank;
  }
  EXPECT_EQ(refusal(sparse(stiffness<2, 2>(cube<2>(0, 1, 60), Model<2>{})), 2), "");
  EXPECT_EQ(refusal(sparse(stiffness<3, 3>(cube<3>(0, 1, 12), Model<3>{})), 3), "");
}

Matrix with_random_units(Random& random, const Matrix& A, double decades) {
  Eigen::VectorXd s(A.rows());
  for (double& value : s) value = std::pow(10, random.between(-decades, decades));
  return s.asDiagonal() * A * s.asDiagonal();
}

// Twice the smallest eigenvalue below the Laplacian, in random units: what is smooth then no level represents, and the
// matrix is too large to be factorised. The energy falls for ever along D^-1 sin sin, which no bound from below ends.
TEST(Definite, StationaryPointsOfShiftedMembranesInRandomUnitsAreNotClaimed) {
  Random random(105);
  constexpr int cells = 241;
  const double eigenvalue = 8 * std::pow(std::sin(std::numbers::pi / 2 / cells), 2);
  for (const double decades : {0.15, 0.3, 0.15, 0.3}) {
    const Matrix A = with_random_units(random, shifted(laplacian(cells), 2 * eigenvalue), decades);
    ASSERT_FALSE(Motions<1>(block_matrix<1>(A)).complete()) << "small enough to be factorised";
    if (!refusal(A).empty()) continue;  // seen by the set-up already
    const Eigen::VectorXd b = Eigen::VectorXd::Constant(A.rows(), 1.0 / static_cast<double>(A.rows())),
                          lower = Eigen::VectorXd::Constant(A.rows(), -1);
    try {
      // Active sets that find the direction first say so.
      const Summary summary = BlackBox(A, 1).solve(b, lower).summary;
      EXPECT_FALSE(summary.converged());
      EXPECT_THAT(summary.reason, HasSubstr("unbounded below"));
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("indefinite: d'Ad is -"));
    }
    return;
  }
  FAIL() << "the set-up has seen them all";
}

// Less its smallest eigenvalue 8 - (that of the Laplacian's roughest function): what has little energy changes its sign
// from each unknown to the next. All couplings are positive, so there are no levels.
TEST(Definite, StationaryPointsWhereRoughFunctionsFallAreNotClaimed) {
  constexpr int cells = 241;
  const double eigenvalue = 8 * std::pow(std::sin(std::numbers::pi / 2 / cells), 2);
  const auto solved = [&](double times) {
    const Matrix L = laplacian(cells), A = -shifted(L, 8 - times * eigenvalue);
    BlackBox solver(A, 1);
    const Eigen::VectorXd b = Eigen::VectorXd::Constant(A.rows(), -1e-6),
                          lower = Eigen::VectorXd::Constant(A.rows(), -1);
    return solver.solve(b, lower).summary.converged();
  };
  EXPECT_THAT([&] { solved(1.4); }, ::testing::ThrowsMessage<Error>(HasSubstr("indefinite: d'Ad is -")));
  EXPECT_TRUE(solved(0.6));
}

TEST(Definite, LongSearches) {
  Random random(106);
  constexpr int cells = 161;
  const double eigenvalue = 8 * std::pow(std::sin(std::numbers::pi / 2 / cells), 2);
  const auto refuses = [&](double times) {
    const Matrix A = with_random_units(random, shifted(laplacian(cells), times * eigenvalue), 0.3);
    try {
      refuse_indefinite_by_steps(block_matrix<1>(A));
      return false;
    } catch (const Error&) {
      return true;
    }
  };
  for (const double times : {1.1, 2.0, 20.0}) EXPECT_TRUE(refuses(times)) << times;
  EXPECT_FALSE(refuses(0.99));
}

}  // namespace
}  // namespace signorini::test
