// Cholesky factorisation of semidefinite matrices, one spring for each motion without energy.
#include "amg/linear/held_cholesky.hpp"

#include <gtest/gtest.h>

#include "tests/amg/matrices.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

Matrix with_unit_diagonal(const Matrix& A) {
  const Eigen::VectorXd scale = Eigen::VectorXd(A.diagonal()).cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * A * scale.asDiagonal();
}

Eigen::VectorXd random_vector(Random& random, Eigen::Index n) {
  Eigen::VectorXd out(n);
  for (double& value : out) value = random.between(-1, 1);
  return out;
}

TEST(HeldCholesky, SolvesDefiniteSystems) {
  Random random(81);
  const Matrix S = with_unit_diagonal(laplacian(12));
  const Eigen::VectorXd x = random_vector(random, S.rows());
  HeldCholesky factor;
  factor.factorise(S);
  EXPECT_EQ(factor.size(), S.rows());
  EXPECT_TRUE(factor.held().empty());
  EXPECT_LE((factor.solve(S * x) - x).norm(), 1e-12 * x.norm());
}

TEST(HeldCholesky, HoldsEachMotionWithoutEnergy) {
  Random random(82);
  const int bodies = 40;
  const Matrix S = with_unit_diagonal(copies(bodies, neumann_laplacian(4)));
  HeldCholesky factor;
  factor.factorise(S);
  EXPECT_EQ(factor.held().size(), static_cast<std::size_t>(bodies));
  const Eigen::VectorXd b = S * random_vector(random, S.rows()), x = factor.solve(b);
  EXPECT_LE((S * x - b).norm(), 1e-12 * b.norm());
  EXPECT_LE(x.norm(), 1e3 * b.norm());
  for (const Eigen::Index held : factor.held()) {
    const Eigen::VectorXd motion = factor.solve(Eigen::VectorXd::Unit(S.rows(), held));
    EXPECT_LE((S * motion).norm(), 1e-12 * motion.norm());
  }
}

TEST(HeldCholesky, TellsADirectionThatFalls) {
  Matrix S = with_unit_diagonal(laplacian(12));
  HeldCholesky factor;
  factor.factorise(S);
  EXPECT_EQ(factor.falling_direction().size(), 0);
  for (Eigen::Index i = 0; i < S.rows(); ++i) S.coeffRef(i, i) -= 0.1;
  factor.factorise(S);
  const Eigen::VectorXd d = factor.falling_direction();
  ASSERT_EQ(d.size(), S.rows());
  EXPECT_LT(d.dot(S * d), 0);
}

// Pivots that are replaced make what follows them grow beyond all numbers.
TEST(HeldCholesky, TellsADirectionThatFallsAmongMany) {
  const Matrix given = with_unit_diagonal(laplacian(81));
  for (const double shift : {1e-3, 1e-2, 0.1, 0.5}) {
    Matrix S = given;
    for (Eigen::Index i = 0; i < S.rows(); ++i) S.coeffRef(i, i) -= shift;
    HeldCholesky factor;
    factor.factorise(S);
    const Eigen::VectorXd d = factor.falling_direction();
    ASSERT_EQ(d.size(), S.rows()) << shift;
    EXPECT_LT(d.dot(S * d), 0) << shift;
  }
}

TEST(HeldCholesky, RefusesToTakeMoreOperationsThanAllowed) {
  const Matrix S = with_unit_diagonal(laplacian(12));
  HeldCholesky factor;
  EXPECT_FALSE(factor.factorise(S, 100));
  EXPECT_EQ(factor.size(), 0);
  EXPECT_TRUE(factor.factorise(S, 1e6));
}

TEST(HeldCholesky, FactorisesMatricesOfLowRank) {
  Random random(83);
  Eigen::MatrixXd X(60, 3);
  for (double& value : X.reshaped()) value = random.between(-1, 1);
  const Matrix S = with_unit_diagonal(Eigen::MatrixXd(X * X.transpose()).sparseView());
  HeldCholesky factor;
  factor.factorise(S);
  EXPECT_EQ(factor.held().size(), 57u);
  const Eigen::VectorXd b = S * random_vector(random, 60);
  EXPECT_LE((S * factor.solve(b) - b).norm(), 1e-10 * b.norm());
}

}  // namespace
}  // namespace signorini::test
