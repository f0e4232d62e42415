// Functionals beside the bounds, friction with a given bound and a scalar kink: against a convex solver that shares
// nothing with the sweeps, and what has to hold on the way.
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/sdk/given_friction.hpp"
#include "core/sdk/given_friction_solver.hpp"
#include "tests/obstacles/kink/convex_kink.hpp"
#include "tests/support/friction.hpp"
#include "tests/support/problems.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

template <int B, class... Local>
class Given final : public FunctionalObstacle<B, Local...> {
 public:
  explicit Given(int data) : data_(data) {}
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", B, 1}}, data_}; }
  void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<B>*, Status&) const noexcept override {}

 private:
  int data_;
};

// Bounds on the first component, friction on the others; some tangential components prescribed by equal bounds.
template <int B>
DiscreteProblem<B> random_friction(Random& random, Index n) {
  DiscreteProblem<B> problem = random_problem<B>(random, n, 0.7);
  Constraints<B>& c = problem.constraints;
  c.width = 1;
  for (Index slot = 0; slot < c.size(); ++slot) {
    for (int k = 1; k < B; ++k) {
      const bool prescribed = B == 3 && k == 2 && random.chance(0.2);
      const double value = random.between(-0.3, 0.3);
      c.lower[slot * B + k] = prescribed ? value : -infinity;
      c.upper[slot * B + k] = prescribed ? value : infinity;
    }
    c.data.push_back(random.chance(0.1) ? 0 : random.between(0, 1));
    for (int k = 0; k < B; ++k) c.last.push_back(random.chance(0.5) ? 0 : random.between(-0.1, 0.1));
    c.tangential.push_back((1u << B) - 2);
  }
  problem.segments = {
      {0, n, std::make_shared<Given<B, GivenFriction<B>, GivenFrictionSolver<B>, GivenFrictionModel<B>>>(1)}};
  return problem;
}

DiscreteProblem<1> random_kinks(Random& random, Index n) {
  DiscreteProblem<1> problem = random_problem<1>(random, n, 0.8);
  Constraints<1>& c = problem.constraints;
  c.width = 5;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (const double value : {random.between(-0.5, 0.5), random.between(-0.2, 1), random.between(0.2, 1),
                               random.between(0, 2), random.between(0, 2)})
      c.data.push_back(value);
  c.tangential.assign(c.vector.size(), 0);
  c.last.assign(c.vector.size(), 0);
  problem.segments = {{0, n, std::make_shared<Given<1, ConvexKink>>(5)}};
  return problem;
}

// Piece by piece.
auto prox_of_kinks(const DiscreteProblem<1>& problem) {
  return [&problem](double rho, Eigen::VectorXd& y) {
    const Constraints<1>& c = problem.constraints;
    for (Index slot = 0; slot < c.size(); ++slot) {
      double& v = y[c.vector[slot]];
      const double *d = c.data.data() + 5 * slot, at = d[0];
      const double left = (rho * v + d[1] + d[3] * at) / (rho + d[3]),
                   right = (rho * v - d[2] + d[4] * at) / (rho + d[4]);
      v = std::clamp(left < at ? left : right > at ? right : at, c.lower[slot], c.upper[slot]);
    }
  };
}

template <int B, class Prox>
void expect_solution(const DiscreteProblem<B>& problem, const Prox& prox, const std::vector<Prolongation>& levels,
                     const SolverOptions& options) {
  const Eigen::VectorXd expected = convex_minimiser(dense(problem.A), vector(problem.b), prox);
  std::vector<double> x = problem.start;
  const Summary summary = solve<B>(problem, levels, x, options, registry());
  ASSERT_EQ(summary.outcome, Outcome::converged) << summary.reason;
  EXPECT_LE((vector(x) - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff())
      << options.method << ", " << summary.iterations << " iterations";
  for (std::size_t k = 1; k < summary.history.size(); ++k)
    EXPECT_LE(summary.history[k].energy, summary.history[k - 1].energy + 1e-12 * std::abs(summary.energy)) << k;
}

template <int B, class Make, class Prox>
void expect_solved(const Make& make, const Prox& prox) {
  Random random(7 + B);
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(trial);
    const auto problem = make(random, 40);
    const std::vector<Prolongation> levels = {random_prolongation(random, 15, 40)};
    for (const char* method : {"auto", "monotone", "tnnmg", "pgs"}) {
      SolverOptions options;
      options.tolerance = 1e-10;
      options.max_iterations = 20000;
      options.method = method;
      expect_solution<B>(problem, prox(problem), levels, options);
      if (options.method == "auto") expect_solution<B>(problem, prox(problem), {}, options);
    }
  }
}

TEST(Functional, KinksAreSolvedLikeByAConvexSolver) { expect_solved<1>(random_kinks, prox_of_kinks); }
TEST(Functional, FrictionInThePlaneIsSolvedLikeByAConvexSolver) {
  expect_solved<2>(random_friction<2>, friction_prox<2>);
}
TEST(Functional, FrictionInSpaceIsSolvedLikeByAConvexSolver) { expect_solved<3>(random_friction<3>, friction_prox<3>); }

// Obstacles with and without a functional in turns, each ruling its own vectors alone.
DiscreteProblem<1> random_turns(Random& random, Index n) {
  DiscreteProblem<1> problem = random_kinks(random, n);
  const std::shared_ptr<const Obstacle<1>> kink = problem.segments[0].obstacle, box = std::make_shared<Box<1>>();
  problem.segments.clear();
  for (Index p = 0; p < n; ++p) problem.segments.push_back({p, p + 1, p % 2 ? kink : box});
  Constraints<1>& c = problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    if (c.vector[slot] % 2 == 0)
      std::fill_n(c.data.begin() + 5 * slot, 5, 0.0);  // what the reference then knows as none
  return problem;
}

TEST(Functional, ObstaclesTakeTurnsVectorByVector) { expect_solved<1>(random_turns, prox_of_kinks); }

// The bound of friction is renewed from the force that presses, as Coulomb's law has it.
class RenewedFriction final
    : public FunctionalObstacle<2, GivenFriction<2>, GivenFrictionSolver<2>, GivenFrictionModel<2>>,
      public Renewal<2> {
 public:
  static constexpr double coefficient = 0.2;
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", 2, 1}}, 1}; }
  void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<2>*, Status&) const noexcept override {}
  const Renewal<2>* renewal() const noexcept override { return this; }
  void renew(const LevelView<2>& level, Index first, Index last, const double* r,
             double* data) const noexcept override {
    for (Index slot = 0; slot < level.slots; ++slot)
      if (const Index p = level.constrained[slot]; p >= first && p < last)
        data[slot] = coefficient * std::max(0.0, -r[2 * p]);
  }
};

TEST(Functional, WhatIsFrozenDuringACycleIsRenewedUntilItFits) {
  Random random(17);
  for (int trial = 0; trial < 5; ++trial) {
    SCOPED_TRACE(trial);
    DiscreteProblem<2> problem = random_friction<2>(random, 40);
    Constraints<2>& c = problem.constraints;
    for (Index slot = 0; slot < c.size(); ++slot) c.upper[2 * slot] = infinity;
    problem.segments = {{0, 40, std::make_shared<RenewedFriction>()}};
    std::vector<double> x = problem.start;
    SolverOptions options;
    options.tolerance = 1e-11;
    const Summary summary = solve<2>(problem, {}, x, options, registry());
    ASSERT_EQ(summary.outcome, Outcome::converged) << summary.reason;
    // Friction with the bounds that follow from the solution has the same solution.
    const Eigen::VectorXd force = dense(problem.A) * vector(x) - vector(problem.b);
    double most = 0;
    for (Index slot = 0; slot < c.size(); ++slot) {
      const bool presses = x[2 * c.vector[slot]] == c.lower[2 * slot];
      c.data[slot] = presses ? RenewedFriction::coefficient * std::max(0.0, force[2 * c.vector[slot]]) : 0;
      most = std::max(most, c.data[slot]);
    }
    EXPECT_GT(most, 0.01) << "nothing presses: no test";
    const Eigen::VectorXd expected = convex_minimiser(dense(problem.A), vector(problem.b), friction_prox<2>(problem));
    EXPECT_LE((vector(x) - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
  }
}

// The local minimiser beside random admissible points near and far.
template <int B, class Phi, class Solver, class Make>
void expect_least(const Make& make) {
  Random random(70 + B);
  for (int trial = 0; trial < 100; ++trial) {
    const auto problem = make(random, 12);
    const Constraints<B>& c = problem.constraints;
    for (Index slot = 0; slot < c.size(); ++slot) {
      const Slot<B> s{c.lower.data() + slot * B, c.upper.data() + slot * B, c.data.data() + slot * c.width,
                      c.last.data() + slot * B, c.tangential[slot]};
      const double* M = problem.A.diagonal(c.vector[slot]);
      double x[B], r[B], y[B];
      for (int k = 0; k < B; ++k) {
        x[k] = std::clamp(random.between(-1, 1), s.lower[k], s.upper[k]);
        r[k] = random.between(-3, 3);
      }
      Solver::minimise(s, M, r, x, y);
      const auto energy = [&](const double* z) {
        double d[B], Md[B], sum = Phi::change(s, y, z);
        for (int k = 0; k < B; ++k) d[k] = z[k] - x[k];
        block::product<B>(M, d, Md);
        for (int k = 0; k < B; ++k) sum += (0.5 * Md[k] - r[k]) * d[k];
        return sum;
      };
      const double least = energy(y);
      for (int other = 0; other < 30; ++other) {
        double z[B];
        const double far = std::pow(10.0, random.between(-6, 0));
        for (int k = 0; k < B; ++k) z[k] = std::clamp(y[k] + far * random.between(-1, 1), s.lower[k], s.upper[k]);
        ASSERT_GE(energy(z), least - 1e-13) << trial << " " << slot;
      }
      for (int k = 0; k < B; ++k) ASSERT_TRUE(y[k] >= s.lower[k] && y[k] <= s.upper[k]);
    }
  }
}

TEST(Functional, LocalMinimisersAreMinimisers) {
  expect_least<1, ConvexKink, ConvexKink>(random_kinks);
  expect_least<2, GivenFriction<2>, GivenFrictionSolver<2>>(random_friction<2>);
  expect_least<3, GivenFriction<3>, GivenFrictionSolver<3>>(random_friction<3>);
}

TEST(Functional, ActiveSetsSayThatTheyKnowBoundsOnly) {
  Random random(3);
  const auto problem = random_kinks(random, 10);
  std::vector<double> x = problem.start;
  SolverOptions options;
  options.method = "pdas";
  try {
    solve<1>(problem, {}, x, options, registry());
    FAIL() << "solved";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    EXPECT_NE(std::string(error.what()).find("'pdas' treats bounds alone"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace signorini::test
