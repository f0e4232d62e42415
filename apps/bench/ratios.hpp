#pragma once
#include "apps/bench/matrices/linear.hpp"
#include "apps/bench/problems.hpp"
#include "apps/bench/shares/traffic.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fem/elements/nested.hpp"

/// What is measured within one run, as a ratio.
namespace signorini::bench {

/// The whole nonlinear solve beside linear multigrid-CG without the obstacle.
struct BesideLinear {
  Solved nonlinear;
  LinearSolve linear;
  double finest_assembly = 0;  ///< of the finest matrix, which both share

  double of_linear(double seconds) const { return seconds / (linear.setup + linear.solve); }
  double solve() const { return nonlinear.times.solve / linear.solve; }
  double set_up_and_solve() const { return of_linear(nonlinear.whole() - finest_assembly); }
  double assembly() const { return of_linear(finest_assembly); }
};

/// @param load of the linear problem, which without it may be trivial; empty: none
template <int D, int B>
BesideLinear beside_linear(const Problem& problem, const std::vector<double>& load) {
  const MeshHierarchy<D> hierarchy = build_hierarchy<D>(problem.scene, B);
  const std::vector<Nodes<D>> nodes = nodes_of(hierarchy, problem.order());
  BesideLinear out{solve_nonlinear<D, B>(problem, hierarchy), {}};
  const Model<B> model = build_model<B>(problem.scene, D, problem.registry, 1);
  Model<B> free = model;
  free.obstacles.clear();
  if (!load.empty()) {
    Load<B> body;
    for (int k = 0; k < B; ++k) body.value[k] = load[k];
    free.loads.push_back(body);
  }
  const auto discretization = discretize<D, B>(nodes.back(), free);
  out.linear = multigrid_cg<B>(discretization.problem, prolongations(hierarchy, nodes), problem.registry,
                               problem.scene.solver.tolerance);
  const Stopwatch watch;
  (void)discretize<D, B>(nodes.back(), model);
  out.finest_assembly = watch.elapsed();
  return out;
}

/// A V(1,1) cycle with contact settled beside what it reads and writes.
struct CycleTraffic {
  Offset unknowns = 0;
  double bytes = 0;
  double time_over = 0;  ///< over that of the traffic
};

/// @param bandwidth bytes per second
template <int D, int B>
CycleTraffic cycle_traffic(const Problem& problem, double bandwidth) {
  const MeshHierarchy<D> hierarchy = build_hierarchy<D>(problem.scene, B);
  const std::vector<Nodes<D>> nodes = nodes_of(hierarchy, problem.order());
  const auto discretization = discretize<D, B>(nodes.back(), build_model<B>(problem.scene, D, problem.registry, 1));
  const auto P = prolongations(hierarchy, nodes);
  Components<B> components{problem.registry.create<Smoother<B>>("smoother", "forward"),
                           [&] { return problem.registry.create<Transfer<B>>("transfer", "min_merge"); },
                           problem.registry.create<CoarseSolver<B>>("coarse", "newton")};
  MonotoneMultigrid<B> multigrid(discretization.problem, P, components, {});
  std::vector<double> x = discretization.problem.start;
  for (int warm = 0; warm < 12; ++warm) multigrid.cycle(x.data());
  double best = infinity;
  for (int run = 0; run < 5; ++run) {
    const Stopwatch watch;
    multigrid.cycle(x.data());
    best = std::min(best, watch.elapsed());
  }
  const double bytes = cycle_bytes<B>(multigrid.levels(), P);
  return {Offset{hierarchy.finest().vertices()} * B, bytes, best * bandwidth / bytes};
}

}  // namespace signorini::bench
