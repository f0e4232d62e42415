#include "apps/bench/choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/problems.hpp"
#include "apps/bench/processor_time.hpp"
#include "core/fem/discretize.hpp"

namespace signorini::bench {
namespace {

using Overrides = std::vector<std::string>;

// What may be picked by hand: every method with every list of steps and the other parts, as far as it converges.
const std::vector<Overrides> methods{{"solver.method=monotone"},
                                     {"solver.method=monotone", "solver.transfer=kornhuber"},
                                     {"solver.method=tnnmg"},
                                     {"solver.method=pdas"}};
const std::vector<Overrides> steps{{},
                                   {"solver.pre=1", "solver.post=1"},
                                   {"solver.pre=1", "solver.post=2"},
                                   {"solver.pre=3", "solver.post=3"},
                                   {"solver.cycle=W"},
                                   {"solver.cycle=F"},
                                   {"solver.coarse=pgs"},
                                   {"solver.relaxation=1.1"},
                                   {"solver.relaxation=1.3"},
                                   {"solver.smoother=surface_first"},
                                   {"solver.smoother=symmetric", "solver.pre=1", "solver.post=1"},
                                   {"solver.krylov=false"}};
constexpr int repetitions = 3;

struct Candidate {
  std::string name;
  Overrides settings;
};

std::vector<Candidate> candidates() {
  std::vector<Candidate> all;
  for (const Overrides& method : methods)
    for (const Overrides& step : steps) {
      Overrides settings = method;
      settings.insert(settings.end(), step.begin(), step.end());
      std::string name;
      for (const std::string& s : settings) name += (name.empty() ? "" : ", ") + s.substr(s.find('.') + 1);
      all.push_back({name, settings});
      if (method.front() == "solver.method=pdas") break;  // it has no steps
    }
  return all;
}

struct Case {
  const char* name;
  const char* scene;
  Overrides overrides;
};

struct Outcome {
  int cycles = 0;
  bool converged = false;
  double seconds = 0;  ///< of processor time: all but the assembly
};

/// Seconds of processor time that the assembly on all meshes takes.
template <int D, int B>
double assembly(const Case& c, const MeshHierarchy<D>& hierarchy) {
  const Problem problem(c.name, c.scene, c.overrides);
  const ProcessorTime time;
  for (const Mesh<D>& mesh : hierarchy.levels)
    (void)discretize<D, B>(mesh, build_model<B>(problem.scene, D, problem.registry, 1));
  return time.elapsed();
}

template <int D, int B>
Outcome outcome(const Case& c, const MeshHierarchy<D>& hierarchy, const Overrides& settings) {
  Overrides overrides = c.overrides;
  overrides.insert(overrides.end(), settings.begin(), settings.end());
  const Problem problem(c.name, c.scene, overrides);
  const ProcessorTime time;
  const Solved solved = solve_nonlinear<D, B>(problem, hierarchy);
  return {solved.summary.iterations, solved.summary.converged(), time.elapsed()};
}

template <int D, int B>
Outcome best_of(const Case& c, const MeshHierarchy<D>& hierarchy, const Overrides& settings, double limit) {
  Outcome best;
  for (int k = 0; k < repetitions; ++k) {
    try {
      const Outcome next = outcome<D, B>(c, hierarchy, settings);
      if (k == 0 || next.seconds < best.seconds) best = next;
    } catch (const Error&) {
      return {};
    }
    if (!best.converged || best.seconds > limit) break;
  }
  return best;
}

template <int D, int B>
void print_case(const Case& c) {
  const MeshHierarchy<D> hierarchy = build_hierarchy<D>(Problem(c.name, c.scene, c.overrides).scene, B);
  const double assembled = std::min(assembly<D, B>(c, hierarchy), assembly<D, B>(c, hierarchy));
  const Outcome automatic = best_of<D, B>(c, hierarchy, {}, 1e9);
  Outcome best;
  std::string name;
  int failed = 0;
  for (const Candidate& candidate : candidates()) {
    const Outcome o = best_of<D, B>(c, hierarchy, candidate.settings, 1.1 * (name.empty() ? automatic : best).seconds);
    failed += !o.converged;
    if (o.converged && (name.empty() || o.seconds < best.seconds)) best = o, name = candidate.name;
  }
  fmt::print("| {} | {} | {}{} | {} | {} | {} | {:.2f} |\n", c.name, hierarchy.finest().vertices() * B,
             automatic.cycles, automatic.converged ? "" : " (limit)", name, best.cycles, failed,
             (automatic.seconds - assembled) / (best.seconds - assembled));
  std::fflush(stdout);
}

}  // namespace

void print_choice() {
  fmt::print(
      "\n## Default over the best picked by hand\n\n"
      "| problem | unknowns | cycles | best | its cycles | failed | default over best |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n");
  const auto refined = [](int k) { return fmt::format("refine.uniform={}", k); };
  const std::string zero = "solver.start=zero";
  print_case<2, 1>({"radial 2D (S2)", "obstacle_radial_2d.toml", {refined(6)}});
  print_case<2, 1>({"radial 2D (S2), zero start", "obstacle_radial_2d.toml", {refined(6), zero}});
  print_case<3, 1>({"radial 3D", "obstacle_radial_3d.toml", {refined(3)}});
  print_case<3, 1>({"cube 3D (S3)", "obstacle_cube_3d.toml", {refined(4)}});
  print_case<2, 1>({"spiral", "obstacle_spiral.toml", {refined(7)}});
  print_case<2, 1>({"degenerate", "obstacle_degenerate.toml", {refined(6)}});
  print_case<2, 1>({"degenerate, zero start", "obstacle_degenerate.toml", {refined(6), zero}});
  print_case<2, 1>({"torsion", "obstacle_torsion_disk.toml", {refined(5)}});
  print_case<2, 2>({"elastic 2D", "signorini_elastic_2d.toml", {refined(6)}});
  print_case<2, 2>({"cylinder on plane", "cylinder_on_plane_2d.toml", {refined(4)}});
  print_case<2, 2>({"disk in bed", "disk_in_bed_steps.toml", {refined(5)}});
  print_case<3, 3>({"ball on plane", "ball_on_plane.toml", {refined(2)}});
  print_case<3, 3>({"ball on plane, zero start", "ball_on_plane.toml", {refined(2), zero}});
  print_case<3, 3>({"cube on bump (E3)", "cube_on_bump.toml", {refined(3)}});
  print_case<3, 3>({"cube on flat bump (E3w)", "cube_on_bump.toml", {refined(3), flat_bump}});
  print_case<3, 3>({"block on surface", "block_on_surface.toml", {refined(3)}});
  print_case<3, 3>({"punch", "punch.toml", {refined(3)}});
  print_case<2, 2>({"cylinder, not refined", "cylinder_on_plane_2d.toml", {refined(0), "body.0.size=0.02"}});
  print_case<3, 3>({"ball, not refined", "ball_on_plane.toml", {refined(0), "body.0.size=0.08"}});
}

}  // namespace signorini::bench
