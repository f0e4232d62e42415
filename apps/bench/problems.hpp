#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/bench/processor_time.hpp"
#include "core/fem/assembly/discretize.hpp"
#include "driver/components.hpp"
#include "driver/levels/nested_solver.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/problem.hpp"

namespace signorini::bench {

/// A file of apps/scenes.
std::filesystem::path scene_file(const std::string& name);

/// That scene, with linear elements unless the overrides say otherwise: on a mesh with as many unknowns as its own
/// quadratic ones have, unless they say so, too.
Scene linear_scene(const std::string& file, std::vector<std::string> overrides);

/// A scene of apps/scenes, changed by overrides as `--set` takes them.
struct Problem {
  std::string name;
  Scene scene;
  Registry registry;

  Problem(std::string title, const std::string& file, std::vector<std::string> overrides);
  /// Of the elements.
  int order() const { return scene.bodies[0].order; }
};

/// E3w's gap, for cube_on_bump.toml: a large part of the bottom comes into contact.
inline const std::string flat_bump = "obstacle.0.distance=\"z + 0.005 + 0.1 * ((x - 0.5)^2 + (y - 0.5)^2)\"";

/// A benchmark problem with `nodes` vertices along an edge, refined as often as that allows: S2, the radial obstacle
/// problem on a square; S3, its analogue on a cube; E3, an elastic cube on a bump; E3w, on a flat one.
/// Error(Exit::usage) for other names and for sizes without a coarser mesh.
Problem benchmark_problem(const std::string& name, int nodes);

/// Seconds of processor time that the assembly on all meshes takes: the least of three.
template <int D, int B>
double assembly_seconds(const Model<B>& model, const MeshHierarchy<D>& hierarchy) {
  double least = infinity;
  for (int run = 0; run < 3; ++run) {
    const ProcessorTime time;
    for (const Mesh<D>& mesh : hierarchy.levels) (void)discretize<D, B>(Nodes(mesh), model);
    least = std::min(least, time.elapsed());
  }
  return least;
}

/// One solve of the whole nonlinear problem.
struct Solved {
  Times times;
  Summary summary;
  Index vertices = 0;
  double unknowns() const { return summary.level_unknowns.back(); }
  double whole() const { return times.assemble + times.setup + times.solve; }
};

template <int D, int B>
Solved solve_nonlinear(const Problem& problem, const MeshHierarchy<D>& hierarchy) {
  const Progress quiet;
  Solved result;
  NestedSolver<D, B> solver(hierarchy, problem.scene.solver, problem.registry, quiet, result.times,
                            nodes_of(hierarchy, problem.order()));
  result.summary = solver.solve(build_model<B>(problem.scene, D, problem.registry, 1)).summary;
  result.vertices = hierarchy.finest().vertices();
  return result;
}

}  // namespace signorini::bench
