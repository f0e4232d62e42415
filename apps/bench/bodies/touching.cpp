#include "apps/bench/bodies/touching.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/bench/matrices/linear.hpp"
#include "apps/bench/problems.hpp"
#include "apps/bench/shares/memory.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fem/elements/nested.hpp"
#include "core/fem/pairs/paired_bodies.hpp"
#include "core/fem/pairs/slave_choice.hpp"
#include "core/solver/local_coordinates.hpp"
#include "driver/scene/touching_bodies.hpp"

namespace signorini::bench {
namespace {

using Pairs = std::shared_ptr<const PairedBodies<3>>;

/// ball_on_block.toml.
struct Touching {
  Problem problem;
  Scene scene;
  MeshHierarchy<3> hierarchy;
  std::vector<Nodes<3>> nodes;
  Model<3> model;

  explicit Touching(int uniform)
      : problem("ball on block", "ball_on_block.toml", {fmt::format("refine.uniform={}", uniform)}),
        scene(with_touching_bodies(problem.scene)),
        hierarchy(build_hierarchy<3>(scene, 3)),
        nodes(nodes_of(hierarchy)),
        model(build_model<3>(scene, 3, problem.registry, 1)) {
    exchange_sides(choose_slaves(nodes.front(), model), model);
  }

  Solution<3> solve(const Model<3>& what, Times& times) const {
    const Progress quiet;
    NestedSolver<3, 3> solver(hierarchy, solver_options(scene, scene.bodies.front()), problem.registry, quiet, times);
    return solver.solve(what);
  }

  double finest_assembly() const {
    Model<3> alone = model;
    alone.obstacles.clear();
    const Stopwatch watch;
    (void)discretize<3, 3>(nodes.back(), alone);
    return watch.elapsed();
  }
};

/// The displacements on a coarser mesh.
std::vector<double> injected(const Prolongation& P, const std::vector<double>& u) {
  std::vector<double> out;
  for (const Index twin : P.twins())
    out.insert(out.end(), u.begin() + Offset{twin} * 3, u.begin() + Offset{twin + 1} * 3);
  return out;
}

/// Everything that two bodies need beside what one needs, on all meshes.
struct Coupling {
  std::vector<Prolongation> prolongations;
  double seconds = 0;

  Coupling(const Touching& touching, const std::vector<double>& u) {
    const auto& nodes = touching.nodes;
    std::vector<std::vector<double>> displacement{u};
    const auto plain = signorini::prolongations(touching.hierarchy, nodes);
    for (std::size_t k = plain.size(); k-- > 0;)
      displacement.insert(displacement.begin(), injected(plain[k], displacement.front()));
    Model<3> alone = touching.model;
    alone.obstacles.clear();
    Pairs coarse;
    for (std::size_t level = 0; level < nodes.size(); ++level) {
      BlockMatrix<3> A = discretize<3, 3>(nodes[level], alone).problem.A;
      const Stopwatch watch;
      const auto fixes = collect_fixes(nodes[level], touching.model);
      const Pairs all = pair_bodies(nodes[level], touching.model, fixes);
      const Pairs pairs = near_contact(nodes[level], touching.model, *all, displacement[level]);
      transform(*pairs->jumps, A);
      if (coarse) prolongations.push_back(between_jumps(plain[level - 1], *pairs->jumps, *coarse->jumps));
      coarse = pairs;
      seconds += watch.elapsed();
    }
  }
};

/// What the solution leaves where nodes in contact keep the jumps that they have.
DiscreteProblem<3> glued(Solution<3>& solution) {
  DiscreteProblem<3> problem = std::move(solution.discretization.problem);
  const Constraints<3> constraints = std::exchange(problem.constraints, {});
  for (Index slot = 0; slot < constraints.size(); ++slot) {
    const Index p = constraints.vector[slot];
    for (int k = 0; k < 3; ++k) {
      const std::size_t at = static_cast<std::size_t>(Offset{p} * 3 + k);
      const double bound = constraints.lower[static_cast<std::size_t>(Offset{slot} * 3 + k)];
      if (!(solution.x[at] <= bound + 1e-12 * std::abs(bound))) continue;
      problem.fixed[p] |= static_cast<Flags>(1u << k);
      problem.start[at] = bound;
    }
  }
  problem.constraints.slot.assign(problem.fixed.size(), -1);
  problem.segments.clear();
  eliminate(problem);
  return problem;
}

void row(int uniform) {
  const Touching touching(uniform);
  Model<3> alone = touching.model;
  alone.obstacles.clear();
  double uncoupled = -begin_measuring();
  {
    Times times;
    (void)touching.solve(alone, times);
    uncoupled += peak_memory();
  }
  double memory = -begin_measuring();
  Times times;
  Solution<3> solution = touching.solve(touching.model, times);
  memory += peak_memory();
  const double whole = times.assemble + times.setup + times.solve;
  const Coupling coupling(touching, to_global(solution.discretization.problem, solution.x));
  const int cycles = solution.summary.iterations;
  const DiscreteProblem<3> problem = glued(solution);
  const LinearSolve linear =
      multigrid_cg<3>(problem, coupling.prolongations, touching.problem.registry, touching.scene.solver.tolerance);
  fmt::print("| {} | {} | {} | {:.2f} | {:.1f} % | {:.2f} |\n", touching.nodes.back().size() * 3, cycles,
             linear.iterations, (whole - touching.finest_assembly()) / (linear.setup + linear.solve),
             100 * coupling.seconds / whole, memory / uncoupled);
  std::fflush(stdout);
}

}  // namespace

void print_touching(bool quick) {
  fmt::print(
      "\n## Bodies in contact with each other\n\n| unknowns | cycles | CG iterations, glued | set-up and solve over "
      "those | part of the coupling | memory over the bodies alone |\n| --- | --- | --- | --- | --- | --- |\n");
  row(2);
  row(3);
  if (!quick) row(4);
}

}  // namespace signorini::bench
