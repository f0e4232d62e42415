// Projected block Gauss-Seidel: the energy falls, bounds hold to the last bit, and the distance to the obstacle has to
// be taken from the iterate every time.
#include <gtest/gtest.h>

#include "core/solver/multigrid.hpp"
#include "smoothers/gauss_seidel.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

template <int B>
std::vector<double> admissible_start(Random& random, const DiscreteProblem<B>& problem, double size) {
  std::vector<double> x;
  for (std::size_t i = 0; i < problem.b.size(); ++i) x.push_back(random.between(-size, size));
  const auto& c = problem.constraints;
  for (std::size_t slot = 0; slot < c.vector.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      double& v = x[static_cast<std::size_t>(c.vector[slot]) * B + k];
      v = std::clamp(v, c.lower[slot * B + k], c.upper[slot * B + k]);
    }
  return x;
}

template <int B>
bool within_bounds(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  const auto& c = problem.constraints;
  for (std::size_t slot = 0; slot < c.vector.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const double v = x[static_cast<std::size_t>(c.vector[slot]) * B + k];
      if (!(v >= c.lower[slot * B + k] && v <= c.upper[slot * B + k])) return false;
    }
  return true;
}

// Energy and the size of its terms, in long double: what the sweeps gain near the end is below rounding otherwise.
template <int B>
std::pair<long double, long double> energy(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  long double e = 0, size = 0;
  const BlockMatrix<B>& A = problem.A;
  for (Index p = 0; p < A.size(); ++p)
    for (int i = 0; i < B; ++i) {
      long double Ax = 0;
      for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
        for (int j = 0; j < B; ++j) Ax += (long double)A.at(k)[i * B + j] * x[A.column[k] * B + j];
      const long double term = (0.5L * Ax - problem.b[p * B + i]) * x[p * B + i];
      e += term;
      size += std::abs(term);
    }
  return {e, size};
}

template <class Size>
class ProjectedSweep : public testing::Test {};
using Sizes =
    testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ProjectedSweep, Sizes);

TYPED_TEST(ProjectedSweep, LowersTheEnergyAndStaysWithinBounds) {
  constexpr int B = TypeParam::value;
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const auto problem = random_problem<B>(random, 40);
    std::vector<double> x = admissible_start(random, problem, 10);
    Level<B> level = finest_level(problem);
    level.x = x.data();
    level.relaxation = random.between(0.1, 1.9);
    auto [before, size] = energy(problem, x);
    for (int sweep = 0; sweep < 200; ++sweep) {
      level.sweep(random.chance(0.5) ? Order::forward : Order::backward);
      const auto [after, scale] = energy(problem, x);
      ASSERT_LE(after, before + 1e-15L * (scale + size)) << trial << ", " << sweep;
      ASSERT_TRUE(within_bounds(problem, x)) << trial << ", " << sweep;
      before = after;
    }
  }
}

TYPED_TEST(ProjectedSweep, ConvergesToTheReferenceSolution) {
  constexpr int B = TypeParam::value;
  Random random(6);
  for (int trial = 0; trial < 5; ++trial) {
    const auto problem = random_problem<B>(random, 25);
    std::vector<double> x(problem.b.size(), 0.0);
    x = admissible_start(random, problem, 1);
    Level<B> level = finest_level(problem);
    level.x = x.data();
    for (int sweep = 0; sweep < 4000; ++sweep) level.sweep(Order::forward);
    const Reference exact = reference(problem);
    EXPECT_LE((vector(x) - exact.x).norm(), 1e-9 * exact.x.norm()) << trial;
  }
}

// The forbidden variant: the distance to the obstacle is stored and updated with every correction.
struct StoredDistance {
  std::vector<double> lower, upper;

  StoredDistance(const DiscreteProblem<1>& problem, const std::vector<double>& x) {
    const auto& c = problem.constraints;
    for (std::size_t slot = 0; slot < c.vector.size(); ++slot) {
      lower.push_back(c.lower[slot] - x[static_cast<std::size_t>(c.vector[slot])]);
      upper.push_back(c.upper[slot] - x[static_cast<std::size_t>(c.vector[slot])]);
    }
  }

  void sweep(const Level<1>& level) {
    const LevelView<1> view = level.view();
    for (Index p = 0; p < level.vectors; ++p) {
      double r;
      row_residual<1>(view, p, &r);
      double d = r * level.inverse[static_cast<std::size_t>(p)];
      if (const Index slot = level.constraints.slot[static_cast<std::size_t>(p)]; slot >= 0) {
        d = std::clamp(d, lower[static_cast<std::size_t>(slot)], upper[static_cast<std::size_t>(slot)]);
        lower[static_cast<std::size_t>(slot)] -= d;
        upper[static_cast<std::size_t>(slot)] -= d;
      }
      level.x[p] += d;
    }
  }
};

TEST(ProjectedSweepDistance, TakenFromTheIterateStaysAdmissibleWhereAStoredOneDoesNot) {
  // A chain pressed on an obstacle, started far above it: on the way down the stored distance collects rounding.
  constexpr Index n = 30;
  DiscreteProblem<1> problem;
  for (Index p = 0; p < n; ++p) {
    problem.A.column.push_back(p);
    problem.A.value.push_back(2);
    for (const Index q : {p - 1, p + 1})
      if (q >= 0 && q < n) {
        problem.A.column.push_back(q);
        problem.A.value.push_back(-1);
      }
    problem.A.row.push_back(static_cast<Offset>(problem.A.column.size()));
    problem.constraints.slot.push_back(p);
    problem.constraints.vector.push_back(p);
    problem.constraints.lower.push_back(1e-3 * std::sin(1.0 + p));
    problem.constraints.upper.push_back(infinity);
  }
  problem.b.assign(n, -1e-3);
  problem.fixed.assign(n, 0);
  problem.start.assign(n, 0);
  problem.segments = {{0, n, std::make_shared<Box<1>>()}};
  const std::vector<double> far(n, 1e6);
  const Reference exact = reference(problem);

  std::vector<double> x = far, wrong = far;
  Level<1> level = finest_level(problem), other = finest_level(problem);
  level.x = x.data();
  other.x = wrong.data();
  StoredDistance stored(problem, wrong);
  for (int sweep = 0; sweep < 20000; ++sweep) {
    level.sweep(Order::forward);
    stored.sweep(other);
  }
  EXPECT_TRUE(within_bounds(problem, x));
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-12 * exact.x.norm());
  EXPECT_FALSE(within_bounds(problem, wrong));
  EXPECT_GE((vector(wrong) - exact.x).norm(), 1e-9 * exact.x.norm());
}

TEST(GaussSeidelOrder, IsWhatTheNameSays) {
  Random random(7);
  const auto problem = random_problem<2>(random, 30);
  const std::vector<double> start = admissible_start(random, problem, 1);
  const auto swept = [&](std::initializer_list<Order> orders) {
    std::vector<double> x = start;
    Level<2> level = finest_level(problem);
    level.x = x.data();
    for (const Order order : orders) level.sweep(order);
    return x;
  };
  const auto smoothed = [&](SweepOrder order, int steps, Side side) {
    std::vector<double> x = start;
    Level<2> level = finest_level(problem);
    level.x = x.data();
    Passes passes;
    const auto smoother = GaussSeidel<2>(order).on(level);
    smoother->add_passes(steps, side, passes);
    Crew alone(1);
    passes.run(level.chunks, alone);
    return x;
  };
  constexpr Order f = Order::forward, b = Order::backward;
  for (const Side side : {Side::descend, Side::ascend}) {
    EXPECT_EQ(smoothed(SweepOrder::forward, 2, side), swept({f, f}));
    EXPECT_EQ(smoothed(SweepOrder::backward, 2, side), swept({b, b}));
    EXPECT_EQ(smoothed(SweepOrder::symmetric, 2, side), swept({f, b, f, b}));
  }
  EXPECT_EQ(smoothed(SweepOrder::adjoint, 2, Side::descend), swept({f, f}));
  EXPECT_EQ(smoothed(SweepOrder::adjoint, 2, Side::ascend), swept({b, b}));
  EXPECT_NE(swept({f}), swept({b}));
}

}  // namespace
}  // namespace signorini::test
