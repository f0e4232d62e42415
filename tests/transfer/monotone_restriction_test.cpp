// Every admissible coarse correction is an admissible fine correction, whatever the weights, frames and phases.
#include <gtest/gtest.h>

#include "tests/transfer/two_levels.hpp"

namespace signorini::test {
namespace {

template <class Size>
class MonotoneRestriction : public testing::Test {};
using Sizes =
    testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(MonotoneRestriction, Sizes);

// A corner or an inner point of the coarse box; up to 1e6 where there is no bound.
template <int B>
std::vector<double> random_correction(Random& random, const Level<B>& coarse, bool corner) {
  std::vector<double> c(static_cast<std::size_t>(coarse.vectors) * B);
  for (Index q = 0; q < coarse.vectors; ++q)
    for (int k = 0; k < B; ++k) {
      if (coarse.off[q] >> k & 1) continue;
      double lower = -1e6, upper = 1e6;
      if (const Index slot = coarse.constraints.slot[q]; slot >= 0) {
        lower = std::max(lower, coarse.constraints.lower[slot * B + k]);
        upper = std::min(upper, coarse.constraints.upper[slot * B + k]);
      }
      c[q * B + k] = corner ? (random.chance(0.5) ? lower : upper) : random.between(lower, upper);
    }
  return c;
}

// Up to rounding of the rotations, which mix all components of a vector.
template <class Levels>
void expect_admissible(const Levels& t, const Eigen::MatrixXd& T, const std::vector<double>& correction) {
  const int B = t.fine.constraints.lower.size() / t.fine.constraints.vector.size();
  const Eigen::VectorXd d = T * vector(correction);
  for (Index slot = 0; slot < t.fine.constraints.size(); ++slot) {
    const Index p = t.fine.constraints.vector[slot];
    double size = 0;
    for (Offset k = t.P.row[p]; k < t.P.row[p + 1]; ++k)
      for (int j = 0; j < B; ++j) {
        double weight = t.P.block.empty() ? std::fabs(t.P.weight[k]) : 0;
        for (int i = 0; i < B && !t.P.block.empty(); ++i) weight += std::fabs(t.P.block[k * B * B + i * B + j]);
        size += weight * std::fabs(correction[t.P.column[k] * B + j]);
      }
    for (int k = 0; k < B; ++k) {
      ASSERT_GE(d[p * B + k], t.fine.phases.lower[slot * B + k] - 1e-14 * size);
      ASSERT_LE(d[p * B + k], t.fine.phases.upper[slot * B + k] + 1e-14 * size);
    }
  }
}

template <int B, template <int> class Restriction>
void expect_every_correction_admissible() {
  Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    TwoLevels<B, Restriction> t(random, 30, trial % 2 == 0, trial % 4 > 1);
    truncate(t.fine, random_flags<B>(random, 30, 0.2 * (trial % 3)));
    reassemble(t.transfer, t.fine, t.coarse);
    t.transfer.restrict_bounds(t.fine, t.coarse);
    for (const double lower : t.coarse.constraints.lower) ASSERT_LE(lower, 0);
    for (const double upper : t.coarse.constraints.upper) ASSERT_GE(upper, 0);
    const Eigen::MatrixXd T = interpolation(t.fine, t.P, t.coarse);
    for (int point = 0; point < 20; ++point)
      expect_admissible(t, T, random_correction(random, t.coarse, point % 2 == 0));
  }
}

TYPED_TEST(MonotoneRestriction, KeepsEveryCoarseCorrectionAdmissible) {
  expect_every_correction_admissible<TypeParam::value, MinMerge>();
  expect_every_correction_admissible<TypeParam::value, Mandel>();
  expect_every_correction_admissible<TypeParam::value, Kornhuber>();
}

TYPED_TEST(MonotoneRestriction, BoundsInnerCoarseVectorsThatReachConstrainedFineOnes) {
  constexpr int B = TypeParam::value;
  Random random(12);
  TwoLevels<B> t(random, 60, true);
  reassemble(t.transfer, t.fine, t.coarse);
  std::fill(t.fine.phases.lower.begin(), t.fine.phases.lower.end(), -1.0);
  std::fill(t.fine.phases.upper.begin(), t.fine.phases.upper.end(), 1.0);
  t.transfer.restrict_bounds(t.fine, t.coarse);
  int inner = 0;
  for (const Index p : t.fine.constraints.vector)
    for (Offset k = t.P.row[p]; k < t.P.row[p + 1]; ++k) {
      const Index q = t.P.column[k], slot = t.coarse.constraints.slot[q];
      ASSERT_GE(slot, 0);
      inner += t.fine.constraints.slot[q] < 0;  // the twin of q has the same number
      for (int i = 0; i < B; ++i) {
        EXPECT_GT(t.coarse.constraints.lower[slot * B + i], -infinity);
        EXPECT_LT(t.coarse.constraints.upper[slot * B + i], infinity);
      }
    }
  EXPECT_GT(inner, 0);
}

TYPED_TEST(MonotoneRestriction, DoesNotTightenBoundsByTruncatedDirections) {
  constexpr int B = TypeParam::value;
  Random random(13);
  TwoLevels<B> t(random, 30, true);
  std::fill(t.fine.phases.lower.begin(), t.fine.phases.lower.end(), 0.0);
  std::fill(t.fine.phases.upper.begin(), t.fine.phases.upper.end(), 0.0);
  std::vector<Flags> all(30, 0);
  for (const Index p : t.fine.constraints.vector) all[p] = (1u << B) - 1;
  truncate(t.fine, all);
  reassemble(t.transfer, t.fine, t.coarse);
  t.transfer.restrict_bounds(t.fine, t.coarse);
  for (const double lower : t.coarse.constraints.lower) EXPECT_EQ(lower, -infinity);
  for (const double upper : t.coarse.constraints.upper) EXPECT_EQ(upper, infinity);
}

/// Fine vectors 0 and 1 are the twins of the coarse ones, the others lie between them.
struct Line {
  std::vector<double> lower, upper;
  std::vector<std::array<double, 2>> weights;  ///< of the others
};

template <template <int> class Restriction>
Constraints<1> restricted(const Line& line) {
  DiscreteProblem<1> problem;
  const auto n = static_cast<Index>(line.lower.size());
  for (Index p = 0; p < n; ++p) {
    problem.A.column.push_back(p);
    problem.A.value.push_back(1);
    problem.A.row.push_back(p + 1);
    problem.constraints.slot.push_back(p);
    problem.constraints.vector.push_back(p);
  }
  problem.b.assign(line.lower.size(), 0);
  problem.fixed.assign(line.lower.size(), 0);
  problem.constraints.lower = line.lower;
  problem.constraints.upper = line.upper;
  problem.segments = {{0, n, std::make_shared<Box<1>>()}};
  Prolongation P;
  P.coarse = 2;
  P.row = {0, 1, 2};
  P.column = {0, 1};
  P.weight = {1, 1};
  for (const auto& [first, second] : line.weights) {
    P.column.insert(P.column.end(), {0, 1});
    P.weight.insert(P.weight.end(), {first, second});
    P.row.push_back(static_cast<Offset>(P.column.size()));
  }
  Level<1> fine = finest_level(problem), coarse;
  fine.clear_phases();
  fine.phases.lower = problem.constraints.lower;
  fine.phases.upper = problem.constraints.upper;
  Restriction<1> transfer;
  transfer.prepare(fine, P, true, coarse);
  coarse.clear_phases();
  reassemble(transfer, fine, coarse);
  transfer.restrict_bounds(fine, coarse);
  return coarse.constraints;
}

using Bounds = std::vector<double>;

// The coarse bounds are those of the fine vectors, an N-th each for N weights.
TEST(MonotoneRestrictionOnALine, MinMergeSharesTheDistanceAmongTheWeights) {
  const auto c = restricted<MinMerge>({{-1, -5, -1}, {4, 3, 10}, {{0.5, -0.25}}});
  EXPECT_EQ(c.lower, (Bounds{-1, -5}));  // -1 / (2 * 0.5) meets -1; 10 / -0.5 < -5
  EXPECT_EQ(c.upper, (Bounds{4, 2}));    // -1 / (2 * -0.25) = 2 < 3
}

TEST(MonotoneRestrictionOnALine, MandelTakesTheLeastDistanceInTheSupport) {
  const auto c = restricted<Mandel>({{-9, -5, -2, -3}, {4, 3, 10, 1}, {{0.75, 0.25}, {0.25, 0.75}}});
  EXPECT_EQ(c.lower, (Bounds{-2, -2}));
  EXPECT_EQ(c.upper, (Bounds{1, 1}));
  const auto negative = restricted<Mandel>({{-1, -5, -1}, {4, 3, 10}, {{0.5, -0.25}}});
  EXPECT_EQ(negative.upper, (Bounds{4, 2})) << "as min_merge";
}

// The four cases of Kornhuber's formula for the middle of an edge.
TEST(MonotoneRestrictionOnALine, KornhuberLeavesTheSmallerEndAsItIs) {
  const auto upper = [](double a, double b, double middle) {
    const double none = infinity;
    return restricted<Kornhuber>({{-none, -none, -none}, {a, b, middle}, {{0.5, 0.5}}}).upper;
  };
  EXPECT_EQ(upper(1, 3, 2), (Bounds{1, 3}));
  EXPECT_EQ(upper(1, 5, 2), (Bounds{1, 3}));
  EXPECT_EQ(upper(5, 1, 2), (Bounds{3, 1}));
  EXPECT_EQ(upper(4, 5, 2), (Bounds{2, 2}));
  EXPECT_EQ(upper(infinity, 0, 2), (Bounds{4, 0}));
  EXPECT_EQ(upper(infinity, infinity, 2), (Bounds{2, 2}));
  const auto lower = restricted<Kornhuber>({{-1, -5, -2}, {9, 9, 9}, {{0.5, 0.5}}}).lower;
  EXPECT_EQ(lower, (Bounds{-1, -3}));
}

TYPED_TEST(MonotoneRestriction, KornhuberIsNowhereTighterThanMinMerge) {
  constexpr int B = TypeParam::value;
  int looser = 0;
  for (int seed = 0; seed < 50; ++seed) {
    Random one(seed), other(seed);
    TwoLevels<B, MinMerge> equal(one, 30, seed % 2 == 0);
    TwoLevels<B, Kornhuber> sharp(other, 30, seed % 2 == 0);
    reassemble(equal.transfer, equal.fine, equal.coarse);
    reassemble(sharp.transfer, sharp.fine, sharp.coarse);
    equal.transfer.restrict_bounds(equal.fine, equal.coarse);
    sharp.transfer.restrict_bounds(sharp.fine, sharp.coarse);
    for (std::size_t i = 0; i < equal.coarse.constraints.lower.size(); ++i) {
      ASSERT_LE(sharp.coarse.constraints.lower[i], equal.coarse.constraints.lower[i] * (1 - 1e-14));
      ASSERT_GE(sharp.coarse.constraints.upper[i], equal.coarse.constraints.upper[i] * (1 - 1e-14));
      looser += sharp.coarse.constraints.upper[i] > equal.coarse.constraints.upper[i] * (1 + 1e-10);
    }
  }
  EXPECT_GT(looser, 50);
}

TYPED_TEST(MonotoneRestriction, ProlongatesWhatTheDefinitionSays) {
  constexpr int B = TypeParam::value;
  Random random(14);
  for (int trial = 0; trial < 20; ++trial) {
    TwoLevels<B> t(random, 30, trial % 2 == 0, trial % 4 > 1);
    truncate(t.fine, random_flags<B>(random, 30, 0.2));
    reassemble(t.transfer, t.fine, t.coarse);
    t.transfer.restrict_bounds(t.fine, t.coarse);
    const Eigen::MatrixXd T = interpolation(t.fine, t.P, t.coarse);

    std::vector<double> r(t.x.size());
    for (double& value : r) value = random.between(-1, 1);
    t.restrict_residual(r);
    EXPECT_LE((vector(t.coarse.own_b) - T.transpose() * vector(r)).norm(), 1e-13);

    // Fine bounds are on the iterate, which starts from zero here.
    const std::vector<double> correction = random_correction(random, t.coarse, true);
    t.coarse.own_x = correction;
    t.prolongate();
    EXPECT_LE((vector(t.x) - T * vector(correction)).norm(), 1e-14 * (1 + vector(correction).norm()) * T.norm());
    for (Index slot = 0; slot < t.fine.constraints.size(); ++slot)
      for (int k = 0; k < B; ++k) {
        EXPECT_GE(t.x[t.fine.constraints.vector[slot] * B + k], t.fine.constraints.lower[slot * B + k]);
        EXPECT_LE(t.x[t.fine.constraints.vector[slot] * B + k], t.fine.constraints.upper[slot * B + k]);
      }
  }
}

}  // namespace
}  // namespace signorini::test
