// Coarse vectors whose fine functions are all truncated: decoupled on every level, and back when contact is released.
#include <gtest/gtest.h>

#include "tests/support/problems.hpp"
#include "tests/transfer/two_levels.hpp"

namespace signorini::test {
namespace {

TEST(Truncation, DecouplesACoarseVectorThatLostAllItsFineFunctions) {
  Random random(31);
  TwoLevels<3> t(random, 45, true);
  const Index lost = 4;
  std::vector<Flags> critical(45, 0);
  for (Index p = 0; p < 45; ++p)
    for (Offset k = t.P.row[p]; k < t.P.row[p + 1]; ++k)
      if (t.P.column[k] == lost) critical[p] = 7;
  reassemble(t.transfer, t.fine, t.coarse);
  const BlockMatrix<3> before = t.coarse.own_matrix;
  truncate(t.fine, critical);
  reassemble(t.transfer, t.fine, t.coarse);
  EXPECT_EQ(t.coarse.off[lost], 7);
  EXPECT_EQ(t.coarse.removed(lost), 7) << "it must not interpolate from still coarser levels";
  const Eigen::MatrixXd C = dense(t.coarse.own_matrix);
  EXPECT_EQ((C.middleRows(lost * 3, 3)), (Eigen::MatrixXd::Identity(C.rows(), C.cols()).middleRows(lost * 3, 3)));
  EXPECT_LE((C - C.transpose()).norm(), 1e-14 * C.norm());

  t.restrict_residual(std::vector<double>(45 * 3, 1.0));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(t.coarse.own_b[lost * 3 + k], 0);
  t.coarse.segments = {{0, t.coarse.vectors, std::make_shared<Box<3>>()}};
  t.transfer.restrict_bounds(t.fine, t.coarse);
  t.coarse.sweep(Order::forward);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(t.coarse.own_x[lost * 3 + k], 0);

  truncate(t.fine, std::vector<Flags>(45, 0));
  reassemble(t.transfer, t.fine, t.coarse);
  EXPECT_EQ(t.coarse.off[lost], 0);
  EXPECT_EQ(t.coarse.removed(lost), 0);
  EXPECT_EQ(t.coarse.own_matrix.value, before.value);
}

// Only the direction along the common normal is lost where the tangential ones remain.
TEST(Truncation, LosesSingleDirectionsOfRotatedVectors) {
  Random random(32);
  TwoLevels<3> t(random, 45, true);
  const auto Q = random_rotation<3>(random);
  t.problem.frames = {};
  for (Index p = 0; p < 45; ++p) t.problem.frames.add(45, p, Q.data(), Q.data());
  Level<3> fine = finest_level(t.problem), coarse;
  fine.clear_phases();
  MinMerge<3> transfer;
  transfer.prepare(fine, t.P, true, coarse);
  coarse.clear_phases();
  truncate(fine, std::vector<Flags>(45, 1));
  reassemble(transfer, fine, coarse);
  for (Index q = 0; q < coarse.vectors; ++q) EXPECT_EQ(coarse.off[q], 1) << q;
}

template <int B>
MonotoneMultigrid<B> multigrid(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations) {
  return {problem,
          prolongations,
          Components<B>{registry().create<Smoother<B>>("smoother", "adjoint"),
                        [] { return registry().create<Transfer<B>>("transfer", "min_merge"); },
                        registry().create<CoarseSolver<B>>("coarse", "newton")},
          {}};
}

TEST(Truncation, IsRecursiveAndEndsWithContact) {
  auto pressed = discretize_all<2, 1>(cube<2>(0, 1, 2), 4, membrane(-1, [](const double*) { return 0.0; }, {}));
  DiscreteProblem<1>& problem = pressed.levels.back();
  auto method = multigrid<1>(problem, pressed.prolongations);
  std::vector<double> x(problem.b.size(), 0.0);
  method.cycle(x.data());
  for (std::size_t k = 0; k + 1 < method.levels().size(); ++k) {
    const Level<1>& level = method.levels()[k];
    const Eigen::MatrixXd C = dense(level.own_matrix);
    EXPECT_EQ(C, (Eigen::MatrixXd::Identity(C.rows(), C.cols()))) << "full contact, level " << k;
  }
  for (double& b : problem.b) b = -b;  // pulled off
  std::vector<double> start(problem.b.size(), 1e-3);
  for (std::size_t p = 0; p < start.size(); ++p)
    if (problem.fixed[p]) start[p] = 0;
  CycleReport report;
  for (int cycle = 0; cycle < 10; ++cycle) report = method.cycle(x.data());
  EXPECT_EQ(report.finest().critical, 0);
  EXPECT_EQ(report.renewed(), 0) << "nothing changes any more";
  auto fresh = multigrid<1>(problem, pressed.prolongations);
  fresh.cycle(start.data());
  for (std::size_t k = 0; k + 1 < method.levels().size(); ++k)
    EXPECT_EQ(method.levels()[k].own_matrix.value, fresh.levels()[k].own_matrix.value) << "level " << k;
}

}  // namespace
}  // namespace signorini::test
