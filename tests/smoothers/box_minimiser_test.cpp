// The exact minimiser of the local problem, against its optimality conditions and against projected coordinate descent.
#include "core/sdk/box_minimiser.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

template <int B>
struct LocalProblem {
  double M[B * B] = {}, inverse[B * B], r[B], lower[B], upper[B];

  void invert() { block::invert<B>(M, inverse); }

  void correct(double* d) const { BoxMinimiser<B>::correct(M, inverse, r, lower, upper, d); }

  double energy(const double* d) const {
    double e = 0;
    for (int i = 0; i < B; ++i) {
      e -= r[i] * d[i];
      for (int j = 0; j < B; ++j) e += 0.5 * d[i] * M[i * B + j] * d[j];
    }
    return e;
  }

  // The largest violation of the optimality conditions, as a displacement in the energy norm.
  double optimality(const double* d) const {
    double worst = 0;
    for (int i = 0; i < B; ++i) {
      double step = r[i];
      for (int j = 0; j < B; ++j) step -= M[i * B + j] * d[j];
      step /= M[i * B + i];
      worst = std::max(worst, std::sqrt(M[i * B + i]) * std::fabs(std::clamp(d[i] + step, lower[i], upper[i]) - d[i]));
    }
    return worst;
  }

  // The largest component of d in the energy norm.
  double size(const double* d) const {
    double largest = 0;
    for (int i = 0; i < B; ++i) largest = std::max(largest, std::sqrt(M[i * B + i]) * std::fabs(d[i]));
    return largest;
  }

  void descend(double* d, int sweeps) const {
    for (int i = 0; i < B; ++i) d[i] = 0;
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (int i = 0; i < B; ++i) {
        double step = r[i];
        for (int j = 0; j < B; ++j) step -= M[i * B + j] * d[j];
        d[i] = std::clamp(d[i] + step / M[i * B + i], lower[i], upper[i]);
      }
  }
};

// M = G'G + shift I with `rank` rows in G.
template <int B>
LocalProblem<B> random_local_problem(Random& random, int rank, double shift = 0) {
  LocalProblem<B> p;
  double G[B][B] = {}, along[B];
  for (int i = 0; i < rank; ++i)
    for (int j = 0; j < B; ++j) G[i][j] = random.between(-1, 1);
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j)
      for (int k = 0; k < rank; ++k) p.M[i * B + j] += G[k][i] * G[k][j];
  for (int i = 0; i < B; ++i) p.M[i * B + i] += shift;
  for (int j = 0; j < B; ++j) along[j] = random.between(-2, 2);
  for (int i = 0; i < B; ++i) {
    p.r[i] = 0;
    for (int j = 0; j < B; ++j) p.r[i] += p.M[i * B + j] * along[j];  // in the range of M: there is a minimum
    const auto [lower, upper] = random_interval(random, 0, 1);
    p.lower[i] = std::min(0.0, random.chance(0.1) ? 0.0 : lower);
    p.upper[i] = std::max(0.0, random.chance(0.1) ? 0.0 : upper);
    if (random.chance(0.1)) p.lower[i] = p.upper[i] = 0;
  }
  p.invert();
  return p;
}

template <class Size>
class BoxMinimiserTest : public testing::Test {};
using Sizes =
    testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(BoxMinimiserTest, Sizes);

TYPED_TEST(BoxMinimiserTest, MeetsTheOptimalityConditions) {
  constexpr int B = TypeParam::value;
  Random random(1);
  for (int trial = 0; trial < 20000; ++trial) {
    const auto p = random_local_problem<B>(random, B, 1e-3);
    double d[B], slow[B];
    p.correct(d);
    for (int i = 0; i < B; ++i) {
      ASSERT_GE(d[i], p.lower[i]) << trial;
      ASSERT_LE(d[i], p.upper[i]) << trial;
    }
    p.descend(slow, 50);
    ASSERT_LE(p.energy(d), p.energy(slow) + 1e-12 * std::fabs(p.energy(slow))) << trial;
    ASSERT_LE(p.optimality(d), 1e-12) << trial;
  }
}

TYPED_TEST(BoxMinimiserTest, HandlesSemidefiniteBlocksWithAMinimum) {
  constexpr int B = TypeParam::value;
  Random random(2);
  for (int trial = 0; trial < 5000 && B > 1; ++trial) {
    const auto p = random_local_problem<B>(random, 1 + random.below(B - 1));
    double d[B], slow[B];
    p.correct(d);
    p.descend(slow, 1000);
    ASSERT_LE(p.energy(d), p.energy(slow) + 1e-10 * std::fabs(p.energy(slow)) + 1e-15) << trial;
    // Singular blocks are raised by 1e-8 of their diagonal: rounding in an inverse of that condition.
    ASSERT_LE(p.optimality(d), 1e8 * B * B * std::numeric_limits<double>::epsilon() * p.size(d)) << trial;
  }
}

TYPED_TEST(BoxMinimiserTest, NeverIncreasesTheEnergyOfAnyBlock) {
  constexpr int B = TypeParam::value;
  Random random(3);
  for (int trial = 0; trial < 50000; ++trial) {
    auto p = random_local_problem<B>(random, random.below(B + 1));
    if (trial % 2 == 0)
      for (double& r : p.r) r += random.between(-1, 1);
    double d[B], size = 0;
    p.correct(d);
    for (int i = 0; i < B; ++i) {
      ASSERT_TRUE(std::isfinite(d[i])) << trial;
      size = std::max(size, std::fabs(p.r[i] * d[i]));
    }
    ASSERT_LE(p.energy(d), 1e-14 * size) << trial;
  }
}

TYPED_TEST(BoxMinimiserTest, IsTheLinearSolutionWithoutBounds) {
  constexpr int B = TypeParam::value;
  Random random(4);
  auto p = random_local_problem<B>(random, B);
  for (int i = 0; i < B; ++i) {
    p.lower[i] = -infinity;
    p.upper[i] = infinity;
  }
  double d[B], expected[B];
  p.correct(d);
  block::product<B>(p.inverse, p.r, expected);
  for (int i = 0; i < B; ++i) EXPECT_EQ(d[i], expected[i]);
}

}  // namespace
}  // namespace signorini::test
