// Problems with more bounds at a vector than components, with and without friction there: against a convex solver that
// shares nothing with the sweeps, and what has to hold on the way.
#include <gtest/gtest.h>

#include "core/sdk/given_friction.hpp"
#include "core/sdk/given_friction_solver.hpp"
#include "tests/support/friction.hpp"
#include "tests/support/random_polyhedra.hpp"

namespace signorini::test {
namespace {

template <int B>
class GivenBound final : public FunctionalObstacle<B, GivenFriction<B>, GivenFrictionSolver<B>, GivenFrictionModel<B>> {
 public:
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", B, 1}}, 1}; }
  void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<B>*, Status&) const noexcept override {}
};

/// Friction in the components behind the first, and facets across.
template <int B>
DiscreteProblem<B> random_friction(Random& random, Index n) {
  DiscreteProblem<B> problem = random_problem<B>(random, n, 0.7);
  Constraints<B>& c = problem.constraints;
  c.width = 1;
  for (Index slot = 0; slot < c.size(); ++slot) {
    for (int k = 1; k < B; ++k) {
      c.lower[slot * B + k] = -infinity;
      c.upper[slot * B + k] = infinity;
    }
    c.data.push_back(random.chance(0.1) ? 0 : random.between(0, 1));
    for (int k = 0; k < B; ++k) c.last.push_back(random.chance(0.5) ? 0 : random.between(-0.1, 0.1));
    c.tangential.push_back((1u << B) - 2);
  }
  add_facets(random, problem);
  problem.segments = {{0, n, std::make_shared<GivenBound<B>>()}};
  return problem;
}

/// Whether the convex solver had a solution to compare with.
template <int B>
bool expect_solution(const DiscreteProblem<B>& problem, const Eigen::VectorXd& expected,
                     const std::vector<Prolongation>& levels, const SolverOptions& options) {
  std::vector<double> x = problem.start;
  const Summary summary = solve<B>(problem, levels, x, options, registry());
  EXPECT_EQ(summary.outcome, Outcome::converged) << options.method << ": " << summary.reason;
  if (expected.size() > 0) {
    EXPECT_LE((vector(x) - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff())
        << options.method << ", " << summary.iterations << " iterations";
  }
  for (std::size_t k = 1; k < summary.history.size(); ++k)
    EXPECT_LE(summary.history[k].energy, summary.history[k - 1].energy + 1e-12 * std::abs(summary.energy)) << k;
  return expected.size() > 0;
}

template <int B, class Make, class Prox>
void expect_solved(const Make& make, const Prox& prox) {
  Random random(7 + B);
  int compared = 0;
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(trial);
    const auto problem = make(random, 40);
    const std::vector<Prolongation> levels = {random_prolongation(random, 15, 40)};
    const Eigen::VectorXd expected = minimiser_with_facets<B>(problem, prox(problem));
    for (const char* method : {"auto", "monotone", "tnnmg", "pgs"}) {
      SolverOptions options;
      options.tolerance = 1e-10;
      options.max_iterations = 20000;
      options.method = method;
      compared += expect_solution<B>(problem, expected, levels, options);
      if (options.method == "auto") expect_solution<B>(problem, expected, {}, options);
    }
  }
  EXPECT_GE(compared, 20) << "of forty";
}

TEST(Polyhedra, InThePlaneAreSolvedLikeByAConvexSolver) { expect_solved<2>(random_polyhedra<2>, clamped<2>); }
TEST(Polyhedra, InSpaceAreSolvedLikeByAConvexSolver) { expect_solved<3>(random_polyhedra<3>, clamped<3>); }
TEST(Polyhedra, WithFrictionInThePlaneAreSolvedLikeByAConvexSolver) {
  expect_solved<2>(random_friction<2>, friction_prox<2>);
}
TEST(Polyhedra, WithFrictionInSpaceAreSolvedLikeByAConvexSolver) {
  expect_solved<3>(random_friction<3>, friction_prox<3>);
}

// Facets are met up to rounding only, and what large forces do along that must not count as an error that is left.
template <int B, class Make>
void expect_solved_to_rounding(const Make& make) {
  Random random(7 + B);
  for (int trial = 0; trial < 30; ++trial) {
    SCOPED_TRACE(trial);
    const auto problem = make(random, 40);
    const std::vector<Prolongation> levels = {random_prolongation(random, 15, 40)};
    for (const char* method : {"auto", "tnnmg"}) {
      SolverOptions options;
      options.tolerance = 1e-12;
      options.max_iterations = 60;
      options.method = method;
      std::vector<double> x = problem.start;
      const Summary summary = solve<B>(problem, levels, x, options, registry());
      EXPECT_EQ(summary.outcome, Outcome::converged) << method << ": " << summary.reason;
    }
  }
}

TEST(Polyhedra, AreSolvedToRounding) {
  expect_solved_to_rounding<2>(random_polyhedra<2>);
  expect_solved_to_rounding<3>(random_polyhedra<3>);
  expect_solved_to_rounding<2>(random_friction<2>);
  expect_solved_to_rounding<3>(random_friction<3>);
}

}  // namespace
}  // namespace signorini::test
