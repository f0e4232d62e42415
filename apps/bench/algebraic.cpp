#include "apps/bench/algebraic.hpp"

#include <fmt/format.h>

#include "amg/black_box.hpp"
#include "apps/bench/linear.hpp"
#include "apps/bench/matrices.hpp"
#include "apps/bench/problems.hpp"

namespace signorini::bench {
namespace {

struct Case {
  const char* name;
  const char* scene;
  int first, last;   // uniform refinements
  double body_load;  // of the linear problem, which without it may be a rigid translation
};

struct Timed {
  double setup = 0, solve = 0;
  Summary summary;
};

template <int B>
Timed black_box(const MatrixProblem& problem) {
  Timed result;
  Stopwatch watch;
  BlackBox solver(problem.A, B);
  result.setup = watch.lap();
  result.summary = solver.solve(problem.b, problem.lower, problem.upper).summary;
  result.solve = watch.lap();
  return result;
}

/// Conjugate gradients on the levels that the matrix gives, from zero.
template <int B>
LinearSolve linear(const MatrixProblem& matrix, double body_load) {
  std::vector<double> load = matrix.b;
  for (double& b : load) b += body_load;
  return algebraic_cg<B>(matrix.A, load, 1e-8);
}

template <int D, int B>
void compare(const Case& c, int uniform) {
  const Problem problem(c.name, c.scene, {fmt::format("refine.uniform={}", uniform)});
  const MeshHierarchy<D> hierarchy = build_hierarchy<D>(problem.scene, B);
  const Solved geometric = solve_nonlinear<D, B>(problem, hierarchy);
  const Model<B> model = build_model<B>(problem.scene, D, problem.registry, 1);
  Stopwatch watch;
  const auto discretization = discretize<D, B>(hierarchy.finest(), model);
  const double geometric_time = geometric.whole() - watch.elapsed();
  const MatrixProblem matrix = matrix_problem(discretization.problem);
  const LinearSolve cg = linear<B>(matrix, c.body_load);
  const Timed box = black_box<B>(matrix);
  const double whole = box.setup + box.solve;
  fmt::print("| {} | {} | {:.2f} | {}{} | {} | {} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {:.2f} |\n", c.name,
             matrix.A.rows, cg.complexity, box.summary.iterations, box.summary.converged() ? "" : " (limit)",
             cg.iterations, geometric.summary.iterations, box.setup, box.solve, box.solve / cg.solve,
             whole / (cg.setup + cg.solve), whole / geometric_time);
  std::fflush(stdout);
}

}  // namespace

void print_algebraic(bool quick) {
  fmt::print(
      "\n## Matrices and bounds alone\n\n| problem | unknowns | complexity | cycles | CG iterations | geometric cycles "
      "| "
      "set-up, s | solve, s | solve over linear | set-up and solve over linear | over geometric |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  const Case s2{"S2", "obstacle_radial_2d.toml", 5, 7, 0}, s3{"S3", "obstacle_cube_3d.toml", 3, 4, 0},
      e3{"E3", "cube_on_bump.toml", 2, 3, 1e-4};
  const int less = quick ? 1 : 0;
  for (int k = s2.first; k <= s2.last - less; ++k) compare<2, 1>(s2, k);
  for (int k = s3.first; k <= s3.last - less; ++k) compare<3, 1>(s3, k);
  for (int k = e3.first; k <= e3.last - less; ++k) compare<3, 3>(e3, k);
}

}  // namespace signorini::bench
