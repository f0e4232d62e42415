// Active sets and interior points where a vector has more bounds than components, or bounds across them: against a
// convex solver that shares nothing with them.
#include <gmock/gmock.h>

#include "methods/active_set.hpp"
#include "methods/interior_point.hpp"
#include "tests/support/random_polyhedra.hpp"

namespace signorini::test {
namespace {

constexpr int trials = 20;

struct Tally {
  int solved = 0, compared = 0, cycled = 0, gave_up = 0;
};

template <class Method, int B>
void judge(const DiscreteProblem<B>& problem, const Eigen::VectorXd& expected, Tally& tally) {
  SolverOptions options;
  options.tolerance = 1e-9;
  options.max_iterations = 60;
  std::vector<double> x = problem.start;
  const Summary summary = Method(problem, x, options, registry(), "cholmod").run({});
  if (summary.reason.find("cycles") != std::string::npos) return void(++tally.cycled);
  if (!summary.converged()) return void(++tally.gave_up);
  ++tally.solved;
  if (expected.size() == 0) return;
  ++tally.compared;
  EXPECT_LE((vector(x) - expected).cwiseAbs().maxCoeff(), 1e-7 * expected.cwiseAbs().maxCoeff());
}

template <int B>
void expect_solved() {
  Random random(31 + B);
  Tally by_sets, by_points;
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE(trial);
    const auto problem = random_polyhedra<B>(random, 40);
    const Eigen::VectorXd expected = minimiser_with_facets<B>(problem, clamped(problem));
    judge<ActiveSetIteration<B>>(problem, expected, by_sets);
    judge<InteriorPointIteration<B>>(problem, expected, by_points);
  }
  EXPECT_EQ(by_sets.gave_up, 0);
  EXPECT_GE(by_sets.compared, trials * 3 / 4);
  EXPECT_GE(by_points.compared, trials / 2) << "facets may leave no room between them";
}

TEST(MethodsWithFacets, FindTheMinimumInThePlane) { expect_solved<2>(); }
TEST(MethodsWithFacets, FindTheMinimumInSpace) { expect_solved<3>(); }

}  // namespace
}  // namespace signorini::test
