// Smoothers that need to know their level: surface first, and patches.
#include <gtest/gtest.h>

#include "core/base/dense.hpp"
#include "core/solver/local_coordinates.hpp"
#include "core/solver/multigrid.hpp"
#include "smoothers/patch.hpp"
#include "smoothers/surface_first.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/problems.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

template <class Size>
class LevelSmoothers : public testing::Test {};
using Sizes =
    testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LevelSmoothers, Sizes);

/// A level of a random problem at the admissible vector next to zero.
template <int B>
struct Start {
  DiscreteProblem<B> problem;
  Level<B> level;
  std::vector<double> x;

  Start(Random& random, Index n, double constrained) : problem(random_problem<B>(random, n, constrained)) {
    problem.fixed[3] = 1;
    problem.start[3 * B] = 0.5;
    if (const Index slot = problem.constraints.slot[3]; slot >= 0) {
      problem.constraints.lower[slot * B] = -infinity;
      problem.constraints.upper[slot * B] = infinity;
    }
    eliminate(problem);
    x = problem.start;
    const Constraints<B>& c = problem.constraints;
    for (std::size_t i = 0; i < c.lower.size(); ++i) {
      double& v = x[c.vector[i / B] * B + i % B];
      if (!(problem.fixed[c.vector[i / B]] >> (i % B) & 1)) v = std::clamp(v, c.lower[i], c.upper[i]);
    }
    level = finest_level(problem);
    level.clear_phases();
    level.x = x.data();
  }

  void smooth(const Smoother<B>& smoother, int steps, Offset chunk_bytes = 1 << 19) {
    level.chunks = divide(problem.A, chunk_bytes);
    const auto on_level = smoother.on(level);
    for (const Side side : {Side::descend, Side::ascend}) {
      Passes passes;
      on_level->add_passes(steps, side, passes);
      Crew alone(1);
      passes.run(level.chunks, alone);
    }
  }

  double energy() const {
    const Eigen::MatrixXd A = dense(problem.A);
    return 0.5 * vector(x).dot(A * vector(x)) - vector(problem.b).dot(vector(x));
  }
};

TYPED_TEST(LevelSmoothers, SurfaceFirstTreatsSurfaceThenInterior) {
  constexpr int B = TypeParam::value;
  Random random(61);
  for (const double constrained : {0.0, 0.05, 1.0}) {
    Start<B> s(random, 80, constrained), expected = s;
    expected.level = s.level;
    expected.level.x = expected.x.data();
    std::vector<char> leads(80, 0);
    for (const Index p : s.problem.constraints.vector)
      for (Offset k = s.problem.A.row[p]; k < s.problem.A.row[p + 1]; ++k) leads[s.problem.A.column[k]] = 1;
    for (int sweep = 0; sweep < 2; ++sweep)
      for (const char wanted : {1, 0})
        for (Index p = 0; p < 80; ++p)
          if (leads[p] == wanted) expected.level.sweep(Order::forward, p, p + 1);
    s.smooth(SurfaceFirst<B>(), 1, 400);
    EXPECT_EQ(s.x, expected.x) << constrained;
  }
}

TYPED_TEST(LevelSmoothers, PatchesLowerTheEnergyWithinTheBounds) {
  constexpr int B = TypeParam::value;
  Random random(62);
  for (const double constrained : {0.0, 0.2, 1.0}) {
    Start<B> s(random, 60, constrained);
    for (int step = 0; step < 5; ++step) {
      const double before = s.energy();
      s.smooth(Patch<B>(), 1);
      EXPECT_LE(s.energy(), before + 1e-13 * std::abs(before));
    }
    const Constraints<B>& c = s.problem.constraints;
    for (std::size_t i = 0; i < c.lower.size(); ++i) {
      if (s.problem.fixed[c.vector[i / B]] >> (i % B) & 1) continue;
      EXPECT_GE(s.x[c.vector[i / B] * B + i % B], c.lower[i]);
      EXPECT_LE(s.x[c.vector[i / B] * B + i % B], c.upper[i]);
    }
    EXPECT_EQ(s.x[3 * B], 0.5) << "what is prescribed stays";
  }
}

// All vectors are neighbours of the first one: a single patch is the whole problem.
TEST(LevelSmoothers, OnePatchOverAllVectorsSolvesTheProblem) {
  Random random(63);
  Start<3> s(random, 12, 0);
  BlockMatrix<3>& A = s.problem.A;
  BlockMatrix<3> full;
  const Eigen::MatrixXd D = dense(A);
  for (Index p = 0; p < 12; ++p) {
    for (Index k = 0; k < 12; ++k) {
      const Index q = k == 0 ? p : k <= p ? k - 1 : k;
      full.column.push_back(q);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) full.value.push_back(D(p * 3 + i, q * 3 + j));
    }
    full.row.push_back(static_cast<Offset>(full.column.size()));
  }
  A = full;
  s.level = finest_level(s.problem);
  s.level.clear_phases();
  s.level.x = s.x.data();
  s.smooth(Patch<3>(), 1);
  const Eigen::VectorXd exact = SymmetricFactors(D).solve(vector(s.problem.b));
  EXPECT_LE((vector(s.x) - exact).norm(), 1e-8 * exact.norm());
}

// Point smoothing hardly damps what nearly keeps the volume.
TEST(LevelSmoothersOnElasticity, PatchesNeedFewerCyclesForNearlyIncompressibleMaterial) {
  for (const double poisson : {0.3, 0.45, 0.49, 0.499}) {
    Model<2> model = pressed_block<2>(plane<2>({0, 0}, {0, 1}), 0.05);
    model.poisson = poisson;
    const auto nested = discretize_all<2, 2>(cube<2>(0, 1, 2), 4, model);
    std::vector<double> x, y;
    SolverOptions options;
    options.max_iterations = 1000;
    const Summary point = solve_from_zero(nested, x, options);
    options.smoother = "patch";
    const Summary patch = solve_from_zero(nested, y, options);
    EXPECT_TRUE(point.converged()) << poisson;
    EXPECT_TRUE(patch.converged()) << poisson;
    EXPECT_LE((vector(x) - vector(y)).norm(), 1e-6 * vector(x).norm());
    EXPECT_LT(patch.iterations, 0.8 * point.iterations) << poisson << ": " << patch.iterations;
  }
}

}  // namespace
}  // namespace signorini::test
