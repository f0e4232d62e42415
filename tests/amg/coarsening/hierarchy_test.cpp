// Levels chosen by the matrix alone: interpolation keeps constants, coarsening is quick, and the solver converges on
// them as on geometric ones.
#include "amg/coarsening/hierarchy.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "amg/coarsening/classical.hpp"
#include "methods/solve.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/core/solver/cases.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

template <int B>
std::unique_ptr<Transfer<B>> min_merge() {
  return registry().create<Transfer<B>>("transfer", "min_merge");
}

TEST(ClassicalInterpolation, ReproducesConstantsAndKeepsTwins) {
  const auto problem = discretize<3, 1>(cube<3>(0, 1, 8), Model<1>{}).problem;
  const Prolongation P = classical_interpolation(problem.A, problem.fixed);
  ASSERT_EQ(P.fine(), problem.A.size());
  EXPECT_LE(P.coarse, P.fine() / 2);
  for (Index p = 0; p < P.fine(); ++p) {
    EXPECT_NEAR(std::accumulate(P.weight.begin() + P.row[p], P.weight.begin() + P.row[p + 1], 0.0), 1, 1e-14);
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) EXPECT_GT(P.weight[k], 0);
  }
  const std::vector<Index> twins = P.twins();
  ASSERT_EQ(static_cast<Index>(twins.size()), P.coarse);
  for (Index q = 0; q < P.coarse; ++q) {
    EXPECT_EQ(P.row[twins[q] + 1], P.row[twins[q]] + 1);
    EXPECT_EQ(P.column[P.row[twins[q]]], q);
  }
}

TEST(ClassicalInterpolation, LeavesOutWhatIsPrescribedOrCoupledToNothing) {
  BlockMatrix<1> A;
  const std::vector<std::vector<double>> rows{{2, -1, 0, 0}, {-1, 2, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (Index p = 0; p < 4; ++p) {
    A.column.push_back(p);
    A.value.push_back(rows[p][p]);
    for (Index q = 0; q < 4; ++q)
      if (q != p && rows[p][q] != 0) {
        A.column.push_back(q);
        A.value.push_back(rows[p][q]);
      }
    A.row.push_back(static_cast<Offset>(A.column.size()));
  }
  const Prolongation P = classical_interpolation(A, {0, 0, 1, 0});
  EXPECT_EQ(P.coarse, 1);
  EXPECT_EQ(P.row, (std::vector<Offset>{0, 1, 2, 2, 2}));
}

TEST(ClassicalInterpolation, OfTheFivePointStencilIsBilinearFromEverySecondLine) {
  constexpr int nodes = 31;
  const DiscreteProblem<1> problem = problem_of(laplacian(nodes + 1));
  const Prolongation P = classical_interpolation(problem.A, problem.fixed);
  EXPECT_EQ(P.coarse, (nodes / 2) * (nodes / 2));
  for (Index p = 0; p < P.fine(); ++p) {
    const int i = p / nodes, j = p % nodes;
    if (std::min(i, j) < 2 || std::max(i, j) > nodes - 3) continue;  // next to the boundary
    const Offset expected = (i % 2 ? 1 : 2) * (j % 2 ? 1 : 2);
    EXPECT_EQ(P.row[p + 1] - P.row[p], expected) << i << " " << j;
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
      const Index twin = P.twin[P.column[k]];
      EXPECT_LE(std::max(std::abs(twin / nodes - i), std::abs(twin % nodes - j)), 1);
      EXPECT_NEAR(P.weight[k], 1.0 / static_cast<double>(expected), 1e-6);
    }
  }
}

TEST(ClassicalInterpolation, FallsOffTowardsPrescribedValues) {
  const DiscreteProblem<1> problem = problem_of(laplacian(32));
  const Prolongation P = classical_interpolation(problem.A, problem.fixed);
  const auto sum = [&](Index p) {
    return std::accumulate(P.weight.begin() + P.row[p], P.weight.begin() + P.row[p + 1], 0.0);
  };
  EXPECT_NEAR(sum(15 * 31 + 14), 1, 1e-6);
  for (Index p = 2; p < 29; ++p) EXPECT_NEAR(sum(p), 0.5, 0.05) << p;  // half way to the boundary
}

// A spring next to which couplings are nothing: all that is interpolated there is zero, and no 0 / 0.
TEST(ClassicalInterpolation, KnowsSpringsThatHoldAllThere) {
  Eigen::SparseMatrix<double> A = laplacian(32);
  for (Eigen::Index i = 0; i < A.rows(); i += 3) A.coeffRef(i, i) = 1e20;
  DiscreteProblem<1> problem = problem_of(A);
  for (const Prolongation& P : algebraic_hierarchy<1>(problem, min_merge<1>, 20).prolongations)
    for (const double weight : P.weight) EXPECT_TRUE(weight >= 0 && weight <= 1) << weight;
}

/// The seven-point stencil on the inner nodes of a cube.
Eigen::SparseMatrix<double> laplacian_of_cube(int cells) {
  const int nodes = cells - 1, plane = nodes * nodes;
  Eigen::SparseMatrix<double> A = copies(nodes, five_point(nodes, [](int) { return 6; }));
  std::vector<Eigen::Triplet<double>> between;
  for (int i = plane; i < plane * nodes; ++i) {
    between.emplace_back(i, i - plane, -1);
    between.emplace_back(i - plane, i, -1);
  }
  Eigen::SparseMatrix<double> planes(A.rows(), A.cols());
  planes.setFromTriplets(between.begin(), between.end());
  return A + planes;
}

/// Entries of all levels over those of the finest one.
double complexity(const DiscreteProblem<1>& problem) {
  const AlgebraicLevels<1> levels = algebraic_hierarchy<1>(problem, min_merge<1>);
  std::size_t entries = problem.A.column.size();
  for (const GalerkinMatrix<1>& coarse : levels.matrices) entries += coarse.A.column.size();
  return static_cast<double>(entries) / static_cast<double>(problem.A.column.size());
}

TEST(AlgebraicHierarchy, HasFewEntries) {
  EXPECT_LE(complexity(problem_of(laplacian(128))), 1.6);
  EXPECT_LE(complexity(problem_of(laplacian_of_cube(32))), 1.6);
}

/// Cycles to the default tolerance on algebraic levels alone; the solution is that of the reference solver.
template <int B>
int cycles(const DiscreteProblem<B>& problem) {
  const auto prolongations = algebraic_hierarchy<B>(problem, min_merge<B>, 20).prolongations;
  EXPECT_GE(prolongations.size(), 2u);
  std::vector<double> x = problem.start;
  const Summary s = solve<B>(problem, prolongations, x, {}, registry());
  EXPECT_TRUE(s.converged()) << s.reason;
  EXPECT_LE(s.rate, 0.4);
  const Reference exact = reference(problem);
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-6 * exact.x.norm());
  return s.iterations;
}

TEST(AlgebraicHierarchy, SolvesObstacleProblemsWithoutAnyMesh) {
  const auto lower = [](const double* x) { return -0.02 - 0.1 * (x[0] - 0.3) * (x[0] - 0.3); };
  for (const int cells : {16, 32, 64})
    EXPECT_LE(cycles<1>(discretize<2, 1>(cube<2>(0, 1, cells), membrane(-1, lower, {})).problem), 20) << cells;
  for (const int cells : {8, 16})
    EXPECT_LE(cycles<1>(discretize<3, 1>(cube<3>(0, 1, cells), membrane(-1, lower, {})).problem), 20) << cells;
}

TEST(AlgebraicHierarchy, SolvesContactProblemsWithoutAnyMesh) {
  for (const auto& c : plane_cases()) {
    if (c.nested.finest().A.size() < 200) continue;
    EXPECT_LE(cycles<2>(c.nested.finest()), 25) << c.name;
  }
}

}  // namespace
}  // namespace signorini::test
