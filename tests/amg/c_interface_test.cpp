// The plain C interface: results are those of the class, errors are statuses with a message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amg/black_box.hpp"
#include "amg/signorini.h"
#include "tests/amg/matrices.hpp"

namespace signorini::test {
namespace {

using testing::HasSubstr;

struct CInterface : testing::Test {
  const SparseRows A = laplacian(40);
  const std::size_t n = static_cast<std::size_t>(A.rows);
  std::vector<double> b = std::vector<double>(n, -1.0 / 1600), lower = std::vector<double>(n, -0.03);
  std::vector<double> x = std::vector<double>(n, 7), multiplier = x;
  signorini_solver* solver = nullptr;

  void TearDown() override { signorini_destroy(solver); }
  int create() { return signorini_create64(A.rows, A.row.data(), A.column.data(), A.value.data(), 1, &solver); }
};

TEST_F(CInterface, GivesWhatTheClassGives) {
  ASSERT_EQ(create(), SIGNORINI_SOLVED) << signorini_message();
  signorini_summary summary;
  ASSERT_EQ(
      signorini_solve(solver, b.data(), lower.data(), nullptr, nullptr, 1e-8, x.data(), multiplier.data(), &summary),
      SIGNORINI_SOLVED);
  EXPECT_THAT(signorini_message(), HasSubstr("are at most 1.000e-08"));
  const BlackBox::Result expected = BlackBox(A).solve(b, lower);
  EXPECT_EQ(x, expected.x);
  EXPECT_EQ(multiplier, expected.multiplier);
  EXPECT_EQ(summary.iterations, expected.summary.iterations);
  EXPECT_EQ(summary.levels, std::ssize(expected.summary.level_unknowns));
  EXPECT_EQ(summary.energy, expected.summary.energy);
}

TEST_F(CInterface, TakesRowsOfEitherWidth) {
  const std::vector<std::int32_t> row(A.row.begin(), A.row.end());
  ASSERT_EQ(signorini_create(A.rows, row.data(), A.column.data(), A.value.data(), 1, &solver), SIGNORINI_SOLVED);
  ASSERT_EQ(signorini_solve(solver, b.data(), nullptr, nullptr, nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_SOLVED);
  EXPECT_EQ(x, BlackBox(A).solve(b).x);
}

TEST_F(CInterface, SolvesToTheToleranceGiven) {
  ASSERT_EQ(create(), SIGNORINI_SOLVED);
  for (const double tolerance : {1e-2, 1e-11}) {
    signorini_summary summary;
    ASSERT_EQ(signorini_solve(solver, b.data(), lower.data(), nullptr, nullptr, tolerance, x.data(), nullptr, &summary),
              SIGNORINI_SOLVED);
    EXPECT_LE(summary.algebraic_error, tolerance);
    EXPECT_GE(summary.algebraic_error, tolerance < 1e-6 ? 0 : 1e-9);
  }
  EXPECT_EQ(signorini_solve(solver, b.data(), nullptr, nullptr, nullptr, 0, x.data(), nullptr, nullptr),
            SIGNORINI_BAD_INPUT);
  EXPECT_THAT(signorini_message(), HasSubstr("tolerance"));
}

TEST_F(CInterface, SaysWhatIsWrongWithTheMatrix) {
  SparseRows broken = A;
  broken.value[1] = 5;
  solver = reinterpret_cast<signorini_solver*>(&broken);
  EXPECT_EQ(signorini_create64(A.rows, broken.row.data(), broken.column.data(), broken.value.data(), 1, &solver),
            SIGNORINI_BAD_INPUT);
  EXPECT_EQ(solver, nullptr);
  EXPECT_THAT(signorini_message(), HasSubstr("not symmetric"));
  EXPECT_EQ(signorini_create64(A.rows, A.row.data(), A.column.data(), A.value.data(), 4, &solver), SIGNORINI_BAD_INPUT);
  EXPECT_THAT(signorini_message(), HasSubstr("block: found 4"));
}

TEST_F(CInterface, RefusesNullWhereAnArrayIsNeeded) {
  EXPECT_EQ(signorini_create64(A.rows, nullptr, A.column.data(), A.value.data(), 1, &solver), SIGNORINI_BAD_INPUT);
  EXPECT_EQ(signorini_create64(A.rows, A.row.data(), nullptr, A.value.data(), 1, &solver), SIGNORINI_BAD_INPUT);
  EXPECT_EQ(signorini_create64(A.rows, A.row.data(), A.column.data(), nullptr, 1, &solver), SIGNORINI_BAD_INPUT);
  EXPECT_THAT(signorini_message(), HasSubstr("value: is null"));
  EXPECT_EQ(signorini_create64(A.rows, A.row.data(), A.column.data(), A.value.data(), 1, nullptr), SIGNORINI_BAD_INPUT);
  EXPECT_EQ(signorini_solve(nullptr, b.data(), nullptr, nullptr, nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_BAD_INPUT);
  ASSERT_EQ(create(), SIGNORINI_SOLVED);
  EXPECT_EQ(signorini_solve(solver, nullptr, nullptr, nullptr, nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_BAD_INPUT);
  EXPECT_EQ(signorini_solve(solver, b.data(), nullptr, nullptr, nullptr, 1e-8, nullptr, nullptr, nullptr),
            SIGNORINI_BAD_INPUT);
  signorini_destroy(nullptr);
}

TEST_F(CInterface, TellsWhereThereIsNoSolutionAndLeavesTheArraysAlone) {
  const std::vector<double> before = x;
  ASSERT_EQ(create(), SIGNORINI_SOLVED);
  std::vector<double> upper(n, -1);
  EXPECT_EQ(signorini_solve(solver, b.data(), lower.data(), upper.data(), nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_NO_SOLUTION);
  EXPECT_THAT(signorini_message(), HasSubstr("infeasible bounds"));
  signorini_destroy(solver);
  const SparseRows floating = neumann_laplacian(10);
  b.assign(121, 1.0);
  ASSERT_EQ(
      signorini_create64(floating.rows, floating.row.data(), floating.column.data(), floating.value.data(), 1, &solver),
      SIGNORINI_SOLVED);
  EXPECT_EQ(signorini_solve(solver, b.data(), nullptr, nullptr, nullptr, 1e-8, x.data(), nullptr, nullptr),
            SIGNORINI_NO_SOLUTION);
  EXPECT_THAT(signorini_message(), HasSubstr("unbounded"));
  EXPECT_EQ(x, before);
}

}  // namespace
}  // namespace signorini::test
