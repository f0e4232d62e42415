#include "apps/bench/matrices/aggregates.hpp"

#include <fmt/format.h>

#include "apps/bench/matrices/linear.hpp"
#include "apps/bench/matrices/matrices.hpp"
#include "apps/bench/problems.hpp"

namespace signorini::bench {
namespace {

struct Case {
  const char* name;
  const char* scene;
  std::vector<std::string> overrides;
};

/// Of the vectors that are not prescribed.
template <int D, int B>
NearNullSpace near_null_space(const Mesh<D>& mesh, const DiscreteProblem<B>& problem) {
  if constexpr (B == 1) return {};
  const std::vector<Index> number = free_vectors(problem);
  std::vector<double> coordinates;
  for (std::size_t p = 0; p < number.size(); ++p)
    if (number[p] >= 0) coordinates.insert(coordinates.end(), mesh.points[p].begin(), mesh.points[p].end());
  return rigid_body_modes<D>(coordinates);
}

/// Without obstacles, under a load everywhere.
template <int D, int B>
LinearSolve linear(const Problem& problem, const Mesh<D>& mesh, const Aggregator& aggregator) {
  Model<B> model = build_model<B>(problem.scene, D, problem.registry, 1);
  model.obstacles.clear();
  const auto discrete = discretize<D, B>(Nodes(mesh), model).problem;
  const MatrixProblem matrix = matrix_problem(discrete);
  const std::vector<double> load(matrix.b.size(), 1.0);
  return algebraic_cg<B>(matrix.A, load, 1e-8, Coarsening::aggregation, near_null_space<D, B>(mesh, discrete),
                         aggregator);
}

struct Figures {
  double unknowns = 0;
  std::string row;
};

template <int D, int B>
Figures figures(const Case& c, const std::string& aggregates) {
  std::vector<std::string> overrides = c.overrides;
  for (const char* further : {"refine.uniform=0", "solver.coarsening=aggregation"}) overrides.emplace_back(further);
  overrides.push_back("solver.aggregates=" + aggregates);
  const Problem problem(c.name, c.scene, overrides);
  const MeshHierarchy<D> hierarchy = build_hierarchy<D>(problem.scene, B);
  const LinearSolve cg =
      linear<D, B>(problem, hierarchy.finest(), *problem.registry.create<Aggregator>("aggregates", aggregates));
  const Solved solved = solve_nonlinear<D, B>(problem, hierarchy);
  return {solved.unknowns(),
          fmt::format("{:.2f} | {} | {}{} | {:.2f} | {:.2f}", cg.complexity, cg.iterations, solved.summary.iterations,
                      solved.summary.converged() ? "" : " (limit)", cg.setup, solved.times.setup + solved.times.solve)};
}

template <int D, int B>
void compare(const Case& c) {
  const Figures greedy = figures<D, B>(c, "greedy"), metis = figures<D, B>(c, "metis");
  fmt::print("| {} | {:.0f} | {} | {} |\n", c.name, greedy.unknowns, greedy.row, metis.row);
  std::fflush(stdout);
}

}  // namespace

void print_aggregates() {
  fmt::print(
      "\n## Aggregates\n\nSmoothed aggregation on meshes that are not refined: entries of all matrices over those of "
      "the finest, iterations of conjugate gradients without obstacles, cycles with them, seconds for the linear "
      "set-up and for the whole solve with obstacles.\n\n"
      "| problem | unknowns | greedy: complexity | CG | cycles | set-up | all | metis: complexity | CG | cycles | "
      "set-up | all |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  compare<2, 1>({"S2, 257 nodes along an edge", "obstacle_radial_2d.toml", {"body.0.cells=[256, 256]"}});
  compare<3, 1>({"S3, 49", "obstacle_cube_3d.toml", {"body.0.cells=[48, 48, 48]"}});
  compare<3, 3>({"E3, 33", "cube_on_bump.toml", {"body.0.cells=[32, 32, 32]"}});
  compare<2, 1>({"torsion of a disk, edges 0.006", "obstacle_torsion_disk.toml", {"body.0.size=0.006"}});
  compare<3, 1>({"scalar ball, edges 0.12", "obstacle_radial_3d.toml", {"body.0.size=0.12"}});
  compare<3, 3>({"half ball on plane, edges 0.08", "ball_on_plane.toml", {"body.0.size=0.08"}});
}

}  // namespace signorini::bench
