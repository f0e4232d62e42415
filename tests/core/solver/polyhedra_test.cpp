// Problems with more bounds at a vector than components, with and without friction there: against a convex solver that
// shares nothing with the sweeps, and what has to hold on the way.
#include <gtest/gtest.h>

#include "core/sdk/given_friction.hpp"
#include "core/solver/polyhedral_box.hpp"
#include "tests/support/friction.hpp"
#include "tests/support/polyhedra.hpp"
#include "tests/support/problems.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

/// Facets at about half of the slots. Their vectors have frames, which the coarse corrections go by.
template <int B>
void add_facets(Random& random, DiscreteProblem<B>& problem) {
  Constraints<B>& c = problem.constraints;
  c.facet_row.assign(1, 0);
  for (Index slot = 0; slot < c.size(); ++slot) {
    double inside[B], I[B * B] = {};
    for (int k = 0; k < B; ++k) {
      inside[k] = std::clamp(random.between(-0.5, 0.5), c.lower[slot * B + k], c.upper[slot * B + k]);
      I[k * (B + 1)] = 1;
    }
    if (random.chance(0.5)) {
      const auto rotation = random_rotation<B>(random);
      std::vector<Facet<B>> facets = random_facets<B>(random, 1 + random.below(B + 1), inside, -1);
      for (const Facet<B>& f : facets) c.facet.push_back(f);
      problem.frames.add(static_cast<std::size_t>(problem.A.size()), c.vector[slot], rotation.data(), rotation.data());
    }
    c.facet_row.push_back(static_cast<Offset>(c.facet.size()));
  }
}

template <int B>
DiscreteProblem<B> random_polyhedra(Random& random, Index n) {
  DiscreteProblem<B> problem = random_problem<B>(random, n, 0.7);
  add_facets(random, problem);
  problem.segments = {{0, n, std::make_shared<PolyhedralBox<B>>()}};
  return problem;
}

template <int B>
class Friction final : public FunctionalObstacle<B, GivenFriction<B>> {
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
  problem.segments = {{0, n, std::make_shared<Friction<B>>()}};
  return problem;
}

/// The unknowns, and behind them what each facet measures.
template <int B>
Eigen::MatrixXd measured(const DiscreteProblem<B>& problem) {
  const Constraints<B>& c = problem.constraints;
  const Eigen::Index n = problem.A.size() * B;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + std::ssize(c.facet), n);
  K.topRows(n).setIdentity();
  for (Index slot = 0; slot < c.size(); ++slot)
    for (Offset f = c.facet_row[slot]; f < c.facet_row[slot + 1]; ++f)
      for (int k = 0; k < B; ++k) K(n + f, c.vector[slot] * B + k) = c.facet[f].normal[k];
  return K;
}

/// Whether the convex solver had a solution to compare with.
template <int B, class Prox>
bool expect_solution(const DiscreteProblem<B>& problem, const Prox& prox, const std::vector<Prolongation>& levels,
                     const SolverOptions& options) {
  const auto with_facets = [&](double rho, Eigen::VectorXd& z) {
    Eigen::VectorXd y = z.head(problem.A.size() * B);
    prox(rho, y);
    z.head(y.size()) = y;
    for (std::size_t f = 0; f < problem.constraints.facet.size(); ++f) {
      double& v = z[y.size() + static_cast<Eigen::Index>(f)];
      v = std::clamp(v, problem.constraints.facet[f].lower, problem.constraints.facet[f].upper);
    }
  };
  const Eigen::VectorXd expected =
      convex_minimiser(dense(problem.A), vector(problem.b), measured(problem), with_facets);
  std::vector<double> x = problem.start;
  const Summary summary = solve<B>(problem, levels, x, options, registry());
  EXPECT_EQ(summary.outcome, Outcome::converged) << options.method << ": " << summary.reason;
  if (expected.size() > 0)
    EXPECT_LE((vector(x) - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff())
        << options.method << ", " << summary.iterations << " iterations";
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
    for (const char* method : {"auto", "monotone", "tnnmg", "pgs"}) {
      SolverOptions options;
      options.tolerance = 1e-10;
      options.max_iterations = 20000;
      options.method = method;
      compared += expect_solution<B>(problem, prox(problem), levels, options);
      if (options.method == "auto") expect_solution<B>(problem, prox(problem), {}, options);
    }
  }
  EXPECT_GE(compared, 20) << "of forty";
}

/// Bounds of components alone.
template <int B>
auto clamped(const DiscreteProblem<B>& problem) {
  return [&problem](double, Eigen::VectorXd& y) {
    const Constraints<B>& c = problem.constraints;
    for (Index slot = 0; slot < c.size(); ++slot)
      for (int k = 0; k < B; ++k) {
        double& v = y[c.vector[slot] * B + k];
        v = std::clamp(v, c.lower[slot * B + k], c.upper[slot * B + k]);
      }
  };
}

TEST(Polyhedra, InThePlaneAreSolvedLikeByAConvexSolver) { expect_solved<2>(random_polyhedra<2>, clamped<2>); }
TEST(Polyhedra, InSpaceAreSolvedLikeByAConvexSolver) { expect_solved<3>(random_polyhedra<3>, clamped<3>); }
TEST(Polyhedra, WithFrictionInThePlaneAreSolvedLikeByAConvexSolver) {
  expect_solved<2>(random_friction<2>, friction_prox<2>);
}
TEST(Polyhedra, WithFrictionInSpaceAreSolvedLikeByAConvexSolver) {
  expect_solved<3>(random_friction<3>, friction_prox<3>);
}

}  // namespace
}  // namespace signorini::test
