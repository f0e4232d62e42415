// Unknowns in units of their own: the same problem, whatever they are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "amg/black_box.hpp"
#include "amg/black_box/row_units.hpp"
#include "core/base/error.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

Eigen::VectorXd random_units(Random& random, Eigen::Index n, double decades) {
  Eigen::VectorXd d(n);
  for (Eigen::Index i = 0; i < n; ++i) d[i] = std::pow(10, random.between(-decades, decades));
  return d;
}

/// A load on a membrane above a floor and below a ceiling, which it meets both.
struct Bounded {
  Matrix A;
  Eigen::VectorXd b, lower, upper;

  explicit Bounded(int cells, Random& random) : A(laplacian(cells)) {
    const Eigen::Index n = A.rows();
    b = Eigen::VectorXd(n);
    for (Eigen::Index i = 0; i < n; ++i) b[i] = random.between(-0.02, 0.02) - (i < n / 2 ? 0.005 : -0.005);
    lower = Eigen::VectorXd::Constant(n, -0.3);
    upper = Eigen::VectorXd::Constant(n, 0.2);
  }

  Bounded in(const Eigen::VectorXd& d) const {
    Bounded out = *this;
    out.A = d.asDiagonal() * A * d.asDiagonal();
    out.b = d.cwiseProduct(b);
    out.lower = lower.cwiseQuotient(d);
    out.upper = upper.cwiseQuotient(d);
    return out;
  }

  BlackBox::Result solve() const { return BlackBox(A).solve(b, lower, upper); }
};

TEST(RowUnits, DoNotMatter) {
  Random random(5);
  const Bounded plain(64, random);
  const Eigen::VectorXd d = random_units(random, plain.A.rows(), 3);
  const Bounded other = plain.in(d);
  const BlackBox::Result expected = plain.solve(), found = other.solve();
  ASSERT_TRUE(found.summary.converged()) << found.summary.reason;
  EXPECT_LE(found.summary.iterations, expected.summary.iterations + 1);
  EXPECT_EQ(found.active, expected.active);
  int at_bounds = 0;
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    EXPECT_NEAR(found.x[i] * d[i], expected.x[i], 1e-8);
    EXPECT_NEAR(found.multiplier[i] / d[i], expected.multiplier[i], 1e-8);
    if (found.active[i] == 0) continue;
    EXPECT_EQ(found.x[i], found.active[i] < 0 ? other.lower[i] : other.upper[i]) << "to the last bit";
    ++at_bounds;
  }
  EXPECT_GT(at_bounds, 100) << "no test";
}

TEST(RowUnits, StayWithAnotherMatrixAndAStart) {
  Random random(6);
  const Bounded plain(32, random), other = plain.in(random_units(random, plain.A.rows(), 2));
  BlackBox solver(other.A);
  const auto cold = solver.solve(other.b, other.lower, other.upper);
  const auto warm = solver.solve(other.b, other.lower, other.upper, cold.x);
  EXPECT_LE(warm.summary.iterations, 1);
  solver.set_matrix(Matrix(2 * other.A));
  const auto twice = solver.solve(Eigen::VectorXd(2 * other.b), other.lower, other.upper);
  for (std::size_t i = 0; i < cold.x.size(); ++i)
    EXPECT_NEAR(twice.x[i], cold.x[i], 1e-7 * std::abs(other.upper[static_cast<Eigen::Index>(i)]));
}

TEST(RowUnits, AreThoseThatMakeTheSmoothConstant) {
  Random random(7);
  const Matrix A = laplacian(30);
  const Eigen::VectorXd d = random_units(random, A.rows(), 1);
  EXPECT_TRUE(recognised_units(A).empty()) << "all are alike";
  const auto units = recognised_units(Matrix(d.asDiagonal() * A * d.asDiagonal()));
  ASSERT_EQ(units.size(), static_cast<std::size_t>(d.size()));
  for (Eigen::Index i = 0; i < d.size(); ++i) EXPECT_NEAR(units[i] * d[i], 0.5, 1e-14);
}

// A graph with couplings over four decades: its diagonal varies, and constants have no energy.
TEST(RowUnits, AreNotThoseOfMaterials) {
  Random random(8);
  Matrix A = laplacian(30);
  Eigen::VectorXd sum = A * Eigen::VectorXd::Ones(A.rows());
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Matrix::InnerIterator entry(A, j); entry; ++entry)
      if (entry.row() < j) {
        const double k = std::pow(10, random.between(-2, 2));
        entry.valueRef() = -k;
        A.coeffRef(j, entry.row()) = -k;
      }
  for (Eigen::Index j = 0; j < A.cols(); ++j) A.coeffRef(j, j) = 0;
  A.diagonal() = sum - A * Eigen::VectorXd::Ones(A.rows());
  EXPECT_TRUE(recognised_units(A).empty());
}

TEST(RowUnits, OfIndefiniteMatricesDoNotHideIt) {
  Random random(9);
  constexpr int cells = 160;
  Matrix A = laplacian(cells), I(A.rows(), A.cols());
  I.setIdentity();
  A -= 1.01 * 8 * std::pow(std::sin(std::numbers::pi / 2 / cells), 2) * I;
  const Eigen::VectorXd d = random_units(random, A.rows(), 3);
  try {
    BlackBox solver(Matrix(d.asDiagonal() * A * d.asDiagonal()));
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("indefinite: d'Ad is -"));
  }
}

TEST(RowUnits, AreThoseOfTheCallerInMessages) {
  Random random(10);
  const Bounded other = Bounded(32, random).in(random_units(random, 31 * 31, 2));
  BlackBox solver(other.A);
  Eigen::VectorXd lower = other.lower;
  lower[4] = 12345;
  try {
    solver.solve(other.b, lower, other.upper);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("12345"));
  }
  Matrix A = other.A;
  A.coeffRef(3, 4) = 12345;
  try {
    BlackBox refused(A);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("12345"));
  }
}

}  // namespace
}  // namespace signorini::test
