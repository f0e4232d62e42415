// Levels by smoothed aggregation: interpolation keeps constants, few entries are enough, and the solver converges on
// them as on those by interpolation from some of the vectors.
#include "amg/coarsening/smoothed_aggregation.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "amg/coarsening/aggregates.hpp"
#include "amg/coarsening/hierarchy.hpp"
#include "methods/solve.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

double row_sum(const Prolongation& P, Index p) {
  return std::accumulate(P.weight.begin() + P.row[p], P.weight.begin() + P.row[p + 1], 0.0);
}

TEST(Aggregates, AreNeighbourhoodsWithTheirRootsAtTheSurface) {
  constexpr int nodes = 31;
  const DiscreteProblem<1> problem = problem_of(laplacian(nodes + 1));
  const StrengthGraph graph = strong_couplings(problem.A, problem.fixed);
  const Aggregates aggregates = aggregate(graph);
  EXPECT_TRUE(std::ranges::is_sorted(aggregates.root));
  std::vector<int> size(aggregates.root.size(), 0);
  for (Index p = 0; p < nodes * nodes; ++p) {
    const Index a = aggregates.of[p];
    ASSERT_GE(a, 0);
    const Index root = aggregates.root[a];
    EXPECT_LE(std::abs(p / nodes - root / nodes) + std::abs(p % nodes - root % nodes), 4);
    EXPECT_LE(graph.neighbours(root).size(), graph.neighbours(p).size());
    ++size[a];
  }
  for (std::size_t a = 0; a < size.size(); ++a) {
    EXPECT_EQ(aggregates.of[aggregates.root[a]], static_cast<Index>(a));
    EXPECT_GE(size[a], 2);
  }
  EXPECT_LE(aggregates.size(), nodes * nodes / 5);
}

TEST(SmoothedAggregation, ReproducesConstantsWithPositiveWeights) {
  const auto scalar = discretize<3, 1>(cube<3>(0, 1, 8), Model<1>{}).problem;
  const auto elastic = discretize<3, 3>(cube<3>(0, 1, 8), Model<3>{}).problem;
  for (const Prolongation& P :
       {smoothed_aggregation(scalar.A, scalar.fixed), smoothed_aggregation(elastic.A, elastic.fixed)}) {
    ASSERT_EQ(P.fine(), scalar.A.size());
    EXPECT_LE(P.coarse, P.fine() / 5);
    EXPECT_EQ(static_cast<Index>(P.twin.size()), P.coarse);
    for (Index p = 0; p < P.fine(); ++p) EXPECT_NEAR(row_sum(P, p), 1, 1e-14);
    for (const double weight : P.weight) EXPECT_GT(weight, 0);
  }
}

TEST(SmoothedAggregation, FallsOffTowardsPrescribedValues) {
  const DiscreteProblem<1> problem = problem_of(laplacian(32));
  const Prolongation P = smoothed_aggregation(problem.A, problem.fixed);
  EXPECT_NEAR(row_sum(P, 15 * 31 + 14), 1, 1e-6);
  for (Index p = 1; p < 30; ++p) EXPECT_NEAR(row_sum(P, p), 1 - 2.0 / 3 / 4, 1e-6);
}

TEST(SmoothedAggregation, LeavesOutWhatIsPrescribedOrCoupledToNothing) {
  Eigen::SparseMatrix<double> A(4, 4);
  for (int i = 0; i < 4; ++i) A.insert(i, i) = i < 2 ? 2 : 1;
  A.insert(0, 1) = A.insert(1, 0) = -1;
  const DiscreteProblem<1> problem = problem_of(A);
  const Prolongation P = smoothed_aggregation(problem.A, {0, 0, 1, 0});
  EXPECT_EQ(P.coarse, 1);
  EXPECT_EQ(P.row, (std::vector<Offset>{0, 1, 2, 2, 2}));
}

template <int B>
AlgebraicLevels<B> aggregated(const DiscreteProblem<B>& problem, Index enough) {
  return algebraic_hierarchy<B>(problem, [] { return registry().create<Transfer<B>>("transfer", "min_merge"); }, enough,
                                {.coarsening = Coarsening::aggregation});
}

TEST(SmoothedAggregation, HasFewEntries) {
  const DiscreteProblem<1> problem = problem_of(laplacian(128));
  std::size_t entries = problem.A.column.size();
  for (const auto& coarse : aggregated(problem, enough_vectors).matrices) entries += coarse.A.column.size();
  EXPECT_LE(static_cast<double>(entries), 1.4 * static_cast<double>(problem.A.column.size()));
}

/// Cycles to the default tolerance; energies fall, and the solution is that of the reference solver.
template <int B>
int cycles(const DiscreteProblem<B>& problem) {
  const auto prolongations = aggregated(problem, 20).prolongations;
  EXPECT_GE(prolongations.size(), 1u);
  std::vector<double> x = problem.start;
  const Summary s = solve<B>(problem, prolongations, x, {}, registry());
  EXPECT_TRUE(s.converged()) << s.reason;
  for (std::size_t k = 1; k < s.history.size(); ++k)
    EXPECT_LE(s.history[k].energy, s.history[k - 1].energy + 1e-12 * std::abs(s.energy));
  const Reference exact = reference(problem);
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-6 * exact.x.norm());
  return s.iterations;
}

double valley(const double* x) { return -0.02 - 0.1 * (x[0] - 0.3) * (x[0] - 0.3); }

TEST(SmoothedAggregation, SolvesLinearProblemsInCyclesThatHardlyGrow) {
  for (const int cells : {16, 32, 64, 128})
    EXPECT_LE(cycles<1>(discretize<2, 1>(cube<2>(0, 1, cells), membrane(-1, {}, {})).problem), 16) << cells;
  for (const int cells : {8, 16})
    EXPECT_LE(cycles<1>(discretize<3, 1>(cube<3>(0, 1, cells), membrane(-1, {}, {})).problem), 16) << cells;
}

TEST(SmoothedAggregation, SolvesObstacleProblems) {
  for (const int cells : {16, 32, 64})
    EXPECT_LE(cycles<1>(discretize<2, 1>(cube<2>(0, 1, cells), membrane(-1, valley, {})).problem), 25) << cells;
  for (const int cells : {8, 16})
    EXPECT_LE(cycles<1>(discretize<3, 1>(cube<3>(0, 1, cells), membrane(-1, valley, {})).problem), 25) << cells;
}

TEST(SmoothedAggregation, SolvesObstacleProblemsWithJumps) {
  for (const double left : {1e6, 1e-6}) {
    Model<1> model = membrane(-1, valley, {});
    model.diffusion = field([=](const double* x) { return x[0] < 0.5 && x[1] < 0.7 ? left : 1; });
    EXPECT_LE(cycles<1>(discretize<2, 1>(cube<2>(0, 1, 64), model).problem), 30) << left;
  }
}

TEST(SmoothedAggregation, SolvesAnisotropicObstacleProblems) {
  const auto floor = [](const double*) { return -0.05; };
  const Mesh<2> stretched = rectangle({0, 0}, {32, 1}, {64, 64});  // couplings 1000 times stronger across
  EXPECT_LE(cycles<1>(discretize<2, 1>(stretched, membrane(-1, floor, {})).problem), 30);
}

TEST(SmoothedAggregation, SolvesContactProblems) {
  for (const auto& c : plane_cases()) {
    if (c.nested.finest().A.size() < 200) continue;
    EXPECT_LE(cycles<2>(c.nested.finest()), 40) << c.name;
  }
}

}  // namespace
}  // namespace signorini::test
