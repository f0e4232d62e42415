#include "apps/bench/matrices/algebraic.hpp"

#include <fmt/format.h>

#include <cmath>

#include "amg/black_box.hpp"
#include "apps/bench/matrices/linear.hpp"
#include "apps/bench/matrices/matrices.hpp"
#include "apps/bench/problems.hpp"
#include "core/base/stopwatch.hpp"

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
  const auto discretization = discretize<D, B>(Nodes(hierarchy.finest()), model);
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

/// Cells along an edge of the coarsest mesh, which is refined once.
struct Hybrid {
  const char* name;
  const char* scene;
  int dimension;
  std::vector<int> cells;
};

std::string cells(int dimension, int along_edge) {
  return dimension == 2 ? fmt::format("body.0.cells=[{0}, {0}]", along_edge)
                        : fmt::format("body.0.cells=[{0}, {0}, {0}]", along_edge);
}

/// The whole solve, meshes and the assembly of the finest matrix left out.
template <int D, int B>
Timed hybrid(const Hybrid& c, int along_edge, const std::vector<std::string>& solver) {
  std::vector<std::string> overrides{cells(c.dimension, along_edge), "refine.uniform=1"};
  overrides.insert(overrides.end(), solver.begin(), solver.end());
  const Problem problem(c.name, c.scene, overrides);
  const Solved solved = solve_nonlinear<D, B>(problem, build_hierarchy<D>(problem.scene, B));
  return {solved.times.setup, solved.times.solve, solved.summary};
}

/// Seconds that the cycles spent on the coarsest mesh and below it.
double coarse_seconds(const Summary& summary) {
  double sum = 0;
  for (const IterationRecord& record : summary.history)
    for (std::size_t k = 0; summary.level_number(k) <= 0; ++k) sum += record.levels[k].seconds;
  return sum;
}

template <int D, int B>
void compare_coarse_solvers(const Hybrid& c, bool quick) {
  const int most = quick ? 2 : 4;
  for (int k = 0; k < most; ++k) {
    const Timed usual = hybrid<D, B>(c, c.cells[k], {});
    const Timed newton = hybrid<D, B>(c, c.cells[k], {"solver.algebraic=false"});
    const Timed sweeps = hybrid<D, B>(c, c.cells[k], {"solver.algebraic=false", "solver.coarse=pgs"});
    const auto over = [&](const Timed& t) {
      return fmt::format("{}{} | {:.2f} | {:.2f}", t.summary.iterations, t.summary.converged() ? "" : " (limit)",
                         coarse_seconds(t.summary) / coarse_seconds(usual.summary),
                         (t.setup + t.solve) / (usual.setup + usual.solve));
    };
    fmt::print("| {} | {} | {} | {:.0f} | {} | {:.4f} | {:.4f} | {} | {} |\n", c.name,
               B * std::lround(std::pow(c.cells[k] + 1, D)), usual.summary.level_number(0),
               static_cast<double>(usual.summary.level_unknowns.back()), usual.summary.iterations,
               coarse_seconds(usual.summary), usual.setup + usual.solve, over(newton), over(sweeps));
    std::fflush(stdout);
  }
}

void print_coarse_solvers(bool quick) {
  fmt::print(
      "\n## Coarse solvers below a mesh\n\n| problem | unknowns on the coarsest mesh | coarsest level | on the finest "
      "mesh | cycles | coarse, s | all, s | Newton's cycles | coarse over | all over | Gauss-Seidel's cycles | coarse "
      "over "
      "| all over |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  compare_coarse_solvers<2, 1>({"S2", "obstacle_radial_2d.toml", 2, {24, 70, 199, 315}}, quick);
  compare_coarse_solvers<3, 1>({"S3", "obstacle_cube_3d.toml", 3, {8, 16, 33, 46}}, quick);
  compare_coarse_solvers<3, 3>({"E3", "cube_on_bump.toml", 3, {5, 11, 23, 32}}, quick);
}

/// The black box on meshes of three sizes.
template <int D, int B>
void grow(const Hybrid& c, bool quick) {
  int first = 0;
  for (std::size_t k = 0; k < c.cells.size() - (quick ? 1 : 0); ++k) {
    const Problem problem(c.name, c.scene, {cells(c.dimension, c.cells[k]), "refine.uniform=0"});
    const MatrixProblem matrix = matrix_problem(discretize<D, B>(Nodes(build_hierarchy<D>(problem.scene, B).finest()),
                                                                 build_model<B>(problem.scene, D, problem.registry, 1))
                                                    .problem);
    const Timed box = black_box<B>(matrix);
    if (first == 0) first = box.summary.iterations;
    fmt::print("| {} | {} | {}{} | {:.2f} | {:.2f} |\n", c.name, matrix.A.rows, box.summary.iterations,
               box.summary.converged() ? "" : " (limit)", static_cast<double>(box.summary.iterations) / first,
               1e6 * (box.setup + box.solve) / matrix.A.rows);
    std::fflush(stdout);
  }
}

void print_growth(bool quick) {
  fmt::print(
      "\n## Cycles of the black box from 1e4 to 1e6 unknowns\n\n| problem | unknowns | cycles | over the first | "
      "set-up and "
      "solve, s per million unknowns |\n| --- | --- | --- | --- | --- |\n");
  grow<2, 1>({"S2", "obstacle_radial_2d.toml", 2, {100, 316, 1000}}, quick);
  grow<3, 1>({"S3", "obstacle_cube_3d.toml", 3, {22, 46, 100}}, quick);
  grow<3, 3>({"E3", "cube_on_bump.toml", 3, {14, 32, 69}}, quick);
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
  print_growth(quick);
  print_coarse_solvers(quick);
}

}  // namespace signorini::bench
