// Solvers for the coarsest level: exact where there are no bounds, also singular and large matrices; monotone with
// them.
#include <gtest/gtest.h>

#include "amg/coarse/coarse_newton.hpp"
#include "core/base/dense.hpp"
#include "core/solver/masked_cg.hpp"
#include "core/solver/multigrid.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/problems.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

template <int B>
Level<B> level_of(const DiscreteProblem<B>& problem, std::vector<double>& x) {
  Level<B> level = finest_level(problem);
  level.x = x.data();
  return level;
}

template <int B>
DiscreteProblem<B> without_conditions(BlockMatrix<B> A, const std::vector<double>& b) {
  DiscreteProblem<B> problem;
  problem.A = std::move(A);
  problem.b = b;
  problem.fixed.assign(static_cast<std::size_t>(problem.A.size()), 0);
  problem.start.assign(problem.b.size(), 0);
  return problem;
}

template <int B>
double relative_residual(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  return (vector(problem.b) - sparse(problem.A) * vector(x)).norm() / vector(problem.b).norm();
}

// b in the range of A.
template <int B>
std::vector<double> consistent_load(const BlockMatrix<B>& A, Random& random) {
  Eigen::VectorXd v(A.size() * B);
  for (auto& value : v) value = random.between(-1, 1);
  const Eigen::VectorXd b = sparse(A) * v;
  return {b.data(), b.data() + b.size()};
}

TEST(CoarseNewton, SolvesSingularSystemsWithAConsistentLoad) {
  Random random(61);
  const auto check = [&](auto A, const char* what) {
    constexpr int B = decltype(A)::block == 1 ? 1 : decltype(A)::block == 4 ? 2 : 3;
    const auto problem = without_conditions<B>(A, consistent_load<B>(A, random));
    std::vector<double> x(problem.b.size(), 0.0);
    EXPECT_TRUE(CoarseNewton<B>().solve(level_of(problem, x))) << what;
    EXPECT_LE(relative_residual(problem, x), 1e-6) << what;
  };
  check(stiffness<2, 1>(cube<2>(0, 1, 8), Model<1>{}), "diffusion 2D");
  check(stiffness<3, 1>(cube<3>(0, 1, 4), Model<1>{}), "diffusion 3D");
  check(stiffness<2, 2>(cube<2>(0, 1, 8), Model<2>{}), "elasticity 2D");
  check(stiffness<3, 3>(cube<3>(0, 1, 3), Model<3>{}), "elasticity 3D");
}

TEST(CoarseNewton, SaysThatASingularSystemWithAnInconsistentLoadHasNoMinimum) {
  const auto check = [](auto A) {
    constexpr int B = decltype(A)::block == 1 ? 1 : decltype(A)::block == 4 ? 2 : 3;
    const auto problem = without_conditions<B>(A, std::vector<double>(static_cast<std::size_t>(A.size()) * B, 1.0));
    std::vector<double> x(problem.b.size(), 0.0);
    EXPECT_FALSE(CoarseNewton<B>().solve(level_of(problem, x)));
  };
  check(stiffness<2, 1>(cube<2>(0, 1, 8), Model<1>{}));
  check(stiffness<2, 2>(cube<2>(0, 1, 8), Model<2>{}));
  check(stiffness<3, 3>(cube<3>(0, 1, 3), Model<3>{}));
}

// Beyond the limit of the factorisation conjugate gradients have to do.
TEST(CoarseNewton, ConvergesOnLevelsTooLargeToFactorise) {
  Nested<1> p;
  Model<1> model = membrane(-1, [](const double*) { return -0.05; }, {});
  p.levels.push_back(discretize<2, 1>(cube<2>(0, 1, 120), model).problem);
  ASSERT_GT(p.finest().A.size(), 12000);
  const Reference exact = reference(p.finest());
  std::vector<double> x;
  const Summary s = solve_from_zero(p, x);
  EXPECT_TRUE(s.converged()) << s.reason;
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-7 * exact.x.norm());
}

template <int B>
void expect_single_level_solution(Random& random) {
  for (int trial = 0; trial < 10; ++trial) {
    Nested<B> p;
    p.levels.push_back(random_problem<B>(random, 80));
    const Reference exact = reference(p.finest());
    for (const char* coarse : {"newton", "pgs"}) {
      SolverOptions options;
      options.coarse = coarse;
      options.tolerance = 1e-10;
      std::vector<double> x;
      const Summary s = solve_from_zero(p, x, options);
      EXPECT_TRUE(s.converged()) << coarse << ", " << trial << ": " << s.reason;
      EXPECT_LE((vector(x) - exact.x).norm(), 1e-8 * exact.x.norm()) << coarse << ", " << trial;
    }
  }
}

TEST(SingleLevel, ConvergesToTheReferenceSolution) {
  Random random(62);
  expect_single_level_solution<1>(random);
  expect_single_level_solution<2>(random);
  expect_single_level_solution<3>(random);
}

template <int B>
double energy_of(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  return 0.5 * vector(x).dot(sparse(problem.A) * vector(x)) - vector(problem.b).dot(vector(x));
}

TEST(CoarseSolvers, LowerTheEnergyWithinTheBounds) {
  Random random(63);
  for (int trial = 0; trial < 30; ++trial) {
    const auto problem = random_problem<2>(random, 40);
    std::vector<double> start(problem.b.size(), 0.0);
    for (Index slot = 0; slot < problem.constraints.size(); ++slot)
      for (int k = 0; k < 2; ++k)
        start[problem.constraints.vector[slot] * 2 + k] = std::clamp(
            random.between(-1, 1), problem.constraints.lower[slot * 2 + k], problem.constraints.upper[slot * 2 + k]);
    const auto check = [&](CoarseSolver<2>& solver, const char* name) {
      std::vector<double> x = start;
      EXPECT_TRUE(solver.solve(level_of(problem, x)));
      EXPECT_LT(energy_of(problem, x), energy_of(problem, start)) << name;
      for (Index slot = 0; slot < problem.constraints.size(); ++slot)
        for (int k = 0; k < 2; ++k) {
          EXPECT_GE(x[problem.constraints.vector[slot] * 2 + k], problem.constraints.lower[slot * 2 + k]) << name;
          EXPECT_LE(x[problem.constraints.vector[slot] * 2 + k], problem.constraints.upper[slot * 2 + k]) << name;
        }
    };
    CoarseNewton<2> newton;
    CoarseGaussSeidel<2> pgs;
    check(newton, "newton");
    check(pgs, "pgs");
  }
}

TEST(MaskedConjugateGradients, SolveOnTheUnmaskedComponentsOnly) {
  Random random(64);
  const auto A = random_matrix<3>(random, 50);
  std::vector<Flags> mask(50, 0);
  for (Flags& m : mask) m = static_cast<Flags>(random.below(8));
  std::vector<double> b(150), d;
  for (double& v : b) v = random.between(-1, 1);
  apply_mask<3>(mask, b);
  std::vector<double> r = b;
  const CgResult result = masked_cg<3>(
      A, mask,
      [&](const std::vector<double>& from, std::vector<double>& z) {
        z.assign(from.size(), 0.0);
        symmetric_gauss_seidel<3>(A, mask, from, z);
      },
      {.reduction = 1e-12, .iterations = 1000, .rounding = 1e-14}, r, d);
  EXPECT_FALSE(result.singular);
  Eigen::MatrixXd M = dense(A);
  for (int i = 0; i < 150; ++i)
    if (mask[i / 3] >> (i % 3) & 1) {
      M.row(i).setZero();
      M.col(i).setZero();
      M(i, i) = 1;
    }
  const Eigen::VectorXd exact = SymmetricFactors(M).solve(vector(b));
  EXPECT_LE((vector(d) - exact).norm(), 1e-9 * exact.norm());
}

}  // namespace
}  // namespace signorini::test
