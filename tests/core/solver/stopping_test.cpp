// When a solve ends, what it reports, and that what it reports is true.
#include <gtest/gtest.h>

#include "core/base/dense.hpp"
#include "core/base/error.hpp"
#include "tests/core/solver/cases.hpp"
#include "tests/support/pdas.hpp"

namespace signorini::test {
namespace {

// max_p ||x_p - Proj(x_p + A_pp^-1 (b - A x)_p)||, the projection in the scalar product of A_pp by coordinate descent.
template <int B>
double natural_residual(const DiscreteProblem<B>& problem, const Eigen::VectorXd& x) {
  const Eigen::VectorXd r = vector(problem.b) - sparse(problem.A) * x;
  double largest = 0;
  for (Index p = 0; p < problem.A.size(); ++p) {
    Eigen::Matrix<double, B, B> D;
    for (int i = 0; i < B * B; ++i) D(i / B, i % B) = problem.A.diagonal(p)[i];
    const Eigen::Matrix<double, B, 1> force = r.template segment<B>(p * B);
    Eigen::Matrix<double, B, 1> step = SymmetricFactors(D).solve(force);
    const Index slot = problem.constraints.slot[p];
    for (int sweep = 0; sweep < 300 && slot >= 0; ++sweep)
      for (int k = 0; k < B; ++k) {
        const double rest = step[k] + (force - D * step)[k] / D(k, k);
        step[k] = std::clamp(rest, problem.constraints.lower[slot * B + k] - x[p * B + k],
                             problem.constraints.upper[slot * B + k] - x[p * B + k]);
      }
    largest = std::max(largest, step.norm());
  }
  return largest;
}

template <int B>
Eigen::VectorXd projected_zero(const DiscreteProblem<B>& problem) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(problem.A.size() * B);
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int k = 0; k < B; ++k) {
      double& v = x[p * B + k];
      if (problem.fixed[p] >> k & 1)
        v = problem.start[p * B + k];
      else if (const Index slot = problem.constraints.slot[p]; slot >= 0)
        v = std::clamp(0.0, problem.constraints.lower[slot * B + k], problem.constraints.upper[slot * B + k]);
    }
  return x;
}

template <int B>
void expect_true_report(const Case<B>& c) {
  const DiscreteProblem<B>& problem = c.nested.finest();
  const double reference_residual = natural_residual(problem, projected_zero(problem));
  std::vector<double> x;
  const Summary s = solve_from_zero(c.nested, x, {}, [&](const IterationRecord& r) {
    const double expected = natural_residual(problem, vector(x)) / (reference_residual > 0 ? reference_residual : 1);
    // Both sums are rounded, in orders of their own: a few hundred machine precisions of the forces in them.
    EXPECT_NEAR(r.residual, expected, 1e-6 * expected + 1e-13) << c.name << ", cycle " << r.iteration;
    return true;
  });
  EXPECT_EQ(s.outcome, Outcome::converged) << c.name << ": " << s.reason;
  EXPECT_LE(s.residual, 1e-8);
  EXPECT_LE(s.algebraic_error, 1e-8);
  EXPECT_EQ(s.iterations, static_cast<int>(s.history.size()));
  for (const IterationRecord& r : s.history)
    EXPECT_EQ(r.residual <= 1e-8 && r.algebraic_error <= 1e-8, r.iteration == s.iterations) << c.name;
  EXPECT_EQ(s.history.back().residual, s.residual);
}

TEST(Stopping, SolvedMeansResidualAndErrorAreBothSmallAndTheResidualIsTheNaturalOne) {
  for (const auto& c : scalar_cases()) expect_true_report(c);
  for (const auto& c : plane_cases()) expect_true_report(c);
  for (const auto& c : space_cases()) expect_true_report(c);
}

TEST(Stopping, EndsWhereRoundingMakesTheToleranceImpossible) {
  // A membrane at height 1e10: its shape takes digits that the numbers do not have.
  Model<1> high = membrane(-1, [](const double*) { return 1e10 - 0.02; }, {});
  high.fixes = {{on("boundary"), {Field(1e10)}}};
  const auto p = discretize_all<2, 1>(cube<2>(0, 1, 2), 4, high);
  std::vector<double> x;
  const Summary s = solve_from_zero(p, x);
  EXPECT_EQ(s.outcome, Outcome::rounding) << s.reason;
  EXPECT_TRUE(s.converged());
  EXPECT_LT(s.iterations, 30);
}

TEST(Stopping, EndsAtRoundingOnEveryCaseWhenTheToleranceIsBelowIt) {
  SolverOptions options;
  options.tolerance = 1e-17;
  const auto check = [&](const auto& c) {
    std::vector<double> x;
    const Summary s = solve_from_zero(c.nested, x, options);
    EXPECT_TRUE(s.converged()) << c.name << ": " << s.reason;
    EXPECT_LT(s.iterations, 80) << c.name << ": " << s.reason;
  };
  for (const auto& c : scalar_cases()) check(c);
  for (const auto& c : plane_cases()) check(c);
}

template <int B>
void expect_unbounded(const Nested<B>& p, const std::string& what) {
  for (const char* truncate : {"normal", "none"}) {
    SolverOptions options;
    options.truncate = truncate;
    std::vector<double> x;
    const Summary s = solve_from_zero(p, x, options);
    EXPECT_EQ(s.outcome, Outcome::unbounded) << what << ", truncate " << truncate << ": " << s.reason;
    EXPECT_LE(s.iterations, 6) << what;
    EXPECT_FALSE(s.converged());
    for (const double v : x) ASSERT_TRUE(std::isfinite(v)) << what;
  }
}

TEST(Stopping, FindsThatNothingHoldsTheBody) {
  expect_unbounded(discretize_all<2, 2>(cube<2>(0, 1, 2), 2, resting_block<2>({0, 1}, {"left"})), "pulled off");
  expect_unbounded(discretize_all<2, 2>(cube<2>(0, 1, 2), 2, resting_block<2>({1, -1}, {})), "pushed sideways");
  expect_unbounded(discretize_all<3, 3>(cube<3>(0, 1, 2), 1, resting_block<3>({0, 0, 1}, {"left", "front"})),
                   "pulled off");
  expect_unbounded(discretize_all<3, 3>(cube<3>(0, 1, 2), 1, resting_block<3>({0.1, 0, -1}, {"front"})),
                   "pushed sideways");
  Model<1> free = membrane(1, [](const double*) { return 0.0; }, {});
  free.fixes.clear();
  expect_unbounded(discretize_all<2, 1>(cube<2>(0, 1, 2), 3, free), "membrane that floats away");
}

// The same membrane pressed on the obstacle is held by it.
TEST(Stopping, TheObstacleAloneMayHoldTheBody) {
  Model<1> free = membrane(-1, [](const double* x) { return x[0] * x[1]; }, {});
  free.fixes.clear();
  const auto p = discretize_all<2, 1>(cube<2>(0, 1, 2), 3, free);
  const Reference exact = reference(p.finest());
  std::vector<double> x;
  EXPECT_EQ(solve_from_zero(p, x).outcome, Outcome::converged);
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-8 * exact.x.norm());
}

// Energy of the solution including prescribed values, from the matrices before any elimination.
template <int B>
void expect_true_energy(const Case<B>& c) {
  std::vector<double> x;
  const Summary s = solve_from_zero(c.nested, x);
  const Eigen::VectorXd u = vector(to_global(c.nested.finest(), x)), Ku = sparse(c.nested.stiffness) * u;
  const double stored = 0.5 * u.dot(Ku), work = vector(c.nested.load).dot(u);
  EXPECT_NEAR(s.energy, stored - work, 1e-12 * (stored + std::abs(work))) << c.name;
}

TEST(Summary, HoldsTheEnergyWithPrescribedValues) {
  for (const auto& c : scalar_cases()) expect_true_energy(c);
  for (const auto& c : plane_cases()) expect_true_energy(c);
  for (const auto& c : space_cases()) expect_true_energy(c);
}

TEST(Stopping, AtTheIterationLimit) {
  const auto c = scalar_cases().front();
  SolverOptions options;
  options.max_iterations = 2;
  std::vector<double> x;
  const Summary s = solve_from_zero(c.nested, x, options);
  EXPECT_EQ(s.outcome, Outcome::iteration_limit);
  EXPECT_EQ(s.iterations, 2);
  EXPECT_FALSE(s.converged());
}

TEST(Stopping, WhenTheMonitorInterrupts) {
  const auto c = scalar_cases().front();
  std::vector<double> x;
  const Summary s = solve_from_zero(c.nested, x, {}, [](const IterationRecord& r) { return r.iteration < 3; });
  EXPECT_EQ(s.outcome, Outcome::interrupted);
  EXPECT_EQ(s.iterations, 3);
  EXPECT_FALSE(s.converged());
}

TEST(Stopping, ValuesThatAreNotFiniteAreRefused) {
  for (const double bad : {std::nan(""), infinity}) {
    auto c = scalar_cases().front();
    c.nested.levels.back().b[300] = bad;
    std::vector<double> x;
    EXPECT_THROW(solve_from_zero(c.nested, x), Error) << bad;
  }
  for (const auto& c : scalar_cases()) {  // bounds on one side and on both must not hide it
    if (c.name != "radial2" && c.name != "two_sided") continue;
    std::vector<double> x(c.nested.finest().b.size(), 0.0);
    x[c.nested.finest().constraints.vector[10]] = std::nan("");
    EXPECT_THROW(solve_from(c.nested, x), Error) << c.name;
  }
}

TEST(Stopping, WhenTheSolutionIsZeroWhateverTheStart) {
  const auto p = discretize_all<2, 1>(cube<2>(0, 1, 2), 3, membrane(0, [](const double*) { return -1.0; }, {}));
  std::vector<double> x;
  const Summary from_zero = solve_from_zero(p, x);
  EXPECT_EQ(from_zero.outcome, Outcome::converged);
  EXPECT_EQ(from_zero.iterations, 1);
  x.assign(x.size(), 1);
  const Summary from_one = solve_from(p, x);
  EXPECT_TRUE(from_one.converged()) << from_one.reason;
  EXPECT_LE(from_one.iterations, 40);
  EXPECT_LE(vector(x).norm(), 1e-8);
}

TEST(Options, OutOfRangeAreRefusedWithTheirNames) {
  const auto c = scalar_cases().back();
  const auto refused = [&](const std::string& name, auto&& change) {
    SolverOptions options;
    change(options);
    std::vector<double> x;
    try {
      solve_from_zero(c.nested, x, options);
      ADD_FAILURE() << name << " was accepted";
    } catch (const Error& e) {
      EXPECT_EQ(e.status(), Exit::input);
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
    }
  };
  using O = SolverOptions;
  refused("cycle", [](O& o) { o.cycle = "X"; });
  refused("truncate", [](O& o) { o.truncate = "all"; });
  refused("rotate", [](O& o) { o.rotate = "some"; });
  refused("method", [](O& o) { o.method = "magic"; });
  refused("tolerance", [](O& o) { o.tolerance = 0; });
  refused("tolerance", [](O& o) { o.tolerance = std::nan(""); });
  refused("max_iterations", [](O& o) { o.max_iterations = 0; });
  refused("pre", [](O& o) { o.pre = o.post = 0; });
  refused("smother", [](O& o) { o.smoother = "smother"; });
  refused("mini_merge", [](O& o) { o.transfer = "mini_merge"; });
  refused("transfer", [](O& o) { o.transfer = "none"; });
  refused("truncate", [](O& o) { o.method = "tnnmg", o.truncate = "none"; });
  refused("cut", [](O& o) { o.cut = -0.1; });
  refused("cut", [](O& o) { o.cut = 0.1, o.truncate = "none"; });
  for (const double factor : {0.0, 2.0, -1.0, std::nan("")})
    refused("relaxation", [=](O& o) { o.relaxation = factor; });
  refused("newtoon", [](O& o) { o.coarse = "newtoon"; });
}

// As the driver adds it, which knows what rounding does to the stiffness.
TEST(Stopping, RoundingThatIsAddedAfterwardsFollowsTheSameRule) {
  const auto with = [](Outcome outcome, double error) {
    Summary summary;
    summary.outcome = outcome;
    summary.algebraic_error = 1e-9;
    summary.add_rounding(error, 1e-8);
    return summary.outcome;
  };
  EXPECT_EQ(with(Outcome::converged, 1e-9), Outcome::converged);
  EXPECT_EQ(with(Outcome::converged, 9e-3), Outcome::rounding);
  EXPECT_EQ(with(Outcome::converged, 1.1e-2), Outcome::inaccurate);
  EXPECT_EQ(with(Outcome::rounding, 1.1e-2), Outcome::inaccurate);
  EXPECT_EQ(with(Outcome::iteration_limit, 1), Outcome::iteration_limit);
}

}  // namespace
}  // namespace signorini::test
