// A functional that comes from a plugin which uses the SDK alone, on scenes.
#include "run.hpp"
#include "scene_text.hpp"
#include "tests/support/convex.hpp"

namespace signorini::test {
namespace {

std::string membrane(const std::string& kink, int refinements) {
  const SceneText scene{.body =
                            "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]\n"
                            "equation = \"diffusion\"",
                        .fixes = {"on = \"left\"\nvalue = [0.2]", "on = \"right\"\nvalue = [-0.1]"},
                        .loads = {"value = [\"3 * sin(7 * x * y)\"]"},
                        .obstacle = "type = \"kink\"\n" + kink,
                        .refinements = refinements};
  return std::string(scene) + "[plugins]\npath = [\"" SIGNORINI_KINK "\"]\n";
}

constexpr const char* kinks = "at = 0.05\nbelow = 1\nabove = 1\nstiffness_below = 2\nstiffness_above = \"1 + x\"";

// Data are written as c, s-, s+, k-, k+.
auto prox_of(const DiscreteProblem<1>& problem) {
  return [&problem](double rho, Eigen::VectorXd& y) {
    const Constraints<1>& c = problem.constraints;
    for (Index p = 0; p < problem.A.size(); ++p)
      if (problem.fixed[p]) y[p] = problem.start[p];
    for (Index slot = 0; slot < c.size(); ++slot) {
      const double *d = c.data.data() + slot * c.width, z = y[c.vector[slot]];
      const double left = (rho * z + d[1] + d[3] * d[0]) / (rho + d[3]);
      const double right = (rho * z - d[2] + d[4] * d[0]) / (rho + d[4]);
      y[c.vector[slot]] = std::clamp(left < d[0] ? left : right > d[0] ? right : d[0], c.lower[slot], c.upper[slot]);
    }
  };
}

TEST(Kink, ScenesAreSolvedLikeByAConvexSolver) {
  for (const std::string bound : {"", "\nlower = \"0.03 - 0.2 * x\""}) {
    const auto r = run<2, 1>(membrane(kinks + bound, 2), {"solver.tolerance=1e-11"});
    const auto& problem = r.problem();
    const Eigen::VectorXd expected = convex_minimiser(dense(problem.A), vector(problem.b), prox_of(problem), 1e-13);
    EXPECT_LE((vector(r.solution.x) - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
    Index resting = 0;
    for (const double u : r.u()) resting += u == 0.05;
    EXPECT_GE(resting, 3) << "the kink holds nothing: no test";
  }
}

// Where asked to SHOW, on larger meshes as well: docs/measured/performance.md.
TEST(Kink, CostsFewIterationsOnAllMeshes) {
  const std::vector<int> tested{4, 6}, shown{4, 6, 7, 8, 9};
  for (const int refinements : std::getenv("SHOW") ? shown : tested) {
    const auto plain = run<2, 1>(membrane("at = 0.05\nstiffness_below = 2\nstiffness_above = 2", refinements));
    const auto kinked = run<2, 1>(membrane(kinks, refinements));
    show("{} refinements: {} and {} iterations\n", refinements, plain.summary().iterations,
         kinked.summary().iterations);
    if (refinements <= tested.back()) {
      EXPECT_LE(kinked.summary().iterations, plain.summary().iterations + 3);
    }
  }
}

}  // namespace
}  // namespace signorini::test
